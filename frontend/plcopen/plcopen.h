// Projects in PLCopen TC6 XML, versions 1.01, 2.0 and 2.01, as Beremiz, OpenPLC Editor, CODESYS, TwinCAT and others
// export them. In: a source file. Out: a text that the ST parser reads, whose locations are places of that file. POUs,
// types and lists of globals are taken wherever they stand; declarations that an editor has kept as text win over the
// structured ones. The text consists of
//
//   {TYPE … END_TYPE | POU | INTERFACE … | {list 'name'} VAR_GLOBAL … END_VAR} {CONFIGURATION … END_CONFIGURATION}
//
// with members before bodies, charts as textual SFC, networks between {network} and {end_network}. What real files
// contain, and what is done about it: docs/files.md. Called by the tool for each input file of this format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"

namespace rung::plcopen {

// By content alone: the root element is a `project` or `pou` of a PLCopen namespace.
bool isPlcopen(std::string_view text);

// A library that the project refers to.
struct Library {
  std::string name;
  std::string space;  // the namespace under which the project knows it, or empty
  Loc loc;
};

// The program that `file` holds, as a file of its own. No file: an error has been reported.
FileId readProject(Sources& sources, FileId file, Diagnostics& diagnostics, std::vector<Library>& libraries);

}  // namespace rung::plcopen
