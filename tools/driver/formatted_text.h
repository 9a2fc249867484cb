// SPDX-License-Identifier: Apache-2.0
// The text of one file as `rung fmt` writes it. In: the text, which need not be on disk, and the style of its project.
// Out: the formatted text. Called by the language server. (fmt.cpp)
#pragma once

#include <optional>
#include <string>

#include "tools/driver/options.h"

namespace rung::driver {

// None: the file has syntax errors, or nothing formats files of its kind. `project`: the dialect and what is defined.
// Only files of text have lines of their own; of others all is formatted.
std::optional<std::string> formattedText(const ProjectOptions& project, const UnsavedFile& file,
                                         const format::Style& style, format::LineRange lines = {});

}  // namespace rung::driver
