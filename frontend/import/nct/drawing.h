// SPDX-License-Identifier: Apache-2.0
// Writes the modules of an NCT program as networks for pictures (docs/networks.md): each instruction as it is written,
// without regard to what its operands mean, so that a program that does not compile yet can be drawn. In: the lines of
// the program. Out: source-mapped text for `rung graph` alone. Called by readProgram (nct.h).
#pragma once

#include "frontend/import/nct/program.h"
#include "frontend/import/source_mapped_text.h"

namespace rung::importer::nct {

void writeDrawing(const Program& program, xml::SourceMappedText& out);

}  // namespace rung::importer::nct
