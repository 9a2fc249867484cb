// SPDX-License-Identifier: Apache-2.0
// Writes an NCT program as ST: symbols as located variables, a PROGRAM for each module, its subroutines as methods, and
// the tasks that run them. In: the lines of the program. Out: source-mapped text, and all that is wrong with the
// program. Called by readProgram (nct.h).
#pragma once

#include "frontend/import/formats.h"
#include "frontend/import/nct/memory.h"
#include "frontend/import/source_mapped_text.h"

namespace rung::importer::nct {

void write(const Program& program, Memory& memory, const LadderSettings& settings, Diagnostics& diagnostics,
           xml::SourceMappedText& out);

}  // namespace rung::importer::nct
