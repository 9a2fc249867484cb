// SPDX-License-Identifier: Apache-2.0
// Files of MULTIPROG and PC Worx: a row of the table of formats.
#pragma once

#include <string_view>

#include "frontend/import/formats.h"

namespace rung::importer::multiprog {

// By content alone: it begins with a comment of the tool.
bool isMultiprog(std::string_view text);

FileId readProgram(ReadContext& context, FileId file);

// All but the descriptions and drawn worksheets.
std::vector<TextPart> programParts(Sources& sources, FileId file, Diagnostics& diagnostics);

}  // namespace rung::importer::multiprog
