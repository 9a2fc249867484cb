// Projects in the XML of IEC 61131-10:2019, which succeeds PLCopen TC6, as Sysmac Studio, GX Works3, nodalis and others
// write them, and single POUs in it. In: a source file. Out: a text that the ST parser reads, whose locations are
// places of that file, in the order that frontend/plcopen/plcopen.h shows. What is read: docs/files.md. Called by the
// tool for each input file of this format.
#pragma once

#include <string_view>

#include "frontend/source/diagnostics.h"

namespace rung::iec10 {

// By content alone: the root element is of the standard's namespace.
bool isIec10(std::string_view text);

// The program that `file` holds, as a file of its own. No file: an error has been reported.
FileId readProject(Sources& sources, FileId file, Diagnostics& diagnostics);

}  // namespace rung::iec10
