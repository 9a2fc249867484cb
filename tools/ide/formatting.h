// SPDX-License-Identifier: Apache-2.0
// Formatting of a file in its editor, as `rung fmt` does it. In: a view. Out: edits of whole lines, none where nothing
// changes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frontend/format/format.h"
#include "tools/ide/text_edits.h"

namespace rung::ide {

// None: the file has syntax errors, or nothing formats it.
std::optional<std::vector<TextEdit>> formattingOf(const View& view, FileId file, format::LineRange lines = {});

// The edits that turn one text into another: lines that differ, where both have equally many, else all from the first
// such line to the last.
std::vector<TextEdit> lineEdits(FileId file, std::string_view before, std::string_view after);

}  // namespace rung::ide
