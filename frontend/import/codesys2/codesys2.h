// SPDX-License-Identifier: Apache-2.0
// Exports of CODESYS 2.3 (.EXP): a row of the table of formats.
#pragma once

#include <string_view>

#include "frontend/import/formats.h"

namespace rung::importer::codesys2 {

// By content alone: it begins with a comment of the export.
bool isCodesys2(std::string_view text);

FileId readProgram(ReadContext& context, FileId file);

// POUs, types and lists of globals, each with the comments of its object before it; no drawn bodies.
std::vector<TextPart> programParts(Sources& sources, FileId file, Diagnostics& diagnostics);

}  // namespace rung::importer::codesys2
