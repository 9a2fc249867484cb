// SPDX-License-Identifier: Apache-2.0
// Projects in PLCopen TC6 XML, versions 1.01, 2.0 and 2.01, as exported by Beremiz, OpenPLC Editor, CODESYS, TwinCAT
// and others. In: a source file. Out: source-mapped text (frontend/import/source_mapped_text.h) that the ST parser
// reads, with locations in that file. POUs, types and lists of globals are read wherever they occur in the file; a
// declaration that an editor has kept as text takes precedence over the structured one. The text consists of
//
//   {TYPE … END_TYPE | POU | INTERFACE … | {list 'name'} VAR_GLOBAL … END_VAR} {CONFIGURATION … END_CONFIGURATION}
//
// with members before bodies, charts as textual SFC, networks between {network} and {end_network}. {list 'name'}
// separates lists of globals, since the text has only one file name. Charts are resolved here by their wires
// (chart.cpp), so their semantics is implemented only once, for textual SFC. docs/files.md describes the content of
// real files. A row of the table of formats.
#pragma once

#include <string_view>

#include "frontend/import/formats.h"

namespace rung::importer::plcopen {

// By content alone: the root element is a `project` or `pou` of a PLCopen namespace.
bool isPlcopen(std::string_view text);

FileId readProgram(ReadContext& context, FileId file);

}  // namespace rung::importer::plcopen
