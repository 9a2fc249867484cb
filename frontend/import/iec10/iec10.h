// Projects in the XML of IEC 61131-10:2019, which succeeds PLCopen TC6, as written by Sysmac Studio, GX Works3, nodalis
// and others, and single POUs in it. In: a source file. Out: source-mapped text that the ST parser reads, with
// locations in that file, in the order described in frontend/import/plcopen/plcopen.h. docs/files.md lists the
// supported elements. Called by the tool for each input file of this format.
#pragma once

#include <string_view>

#include "frontend/source/diagnostics.h"

namespace rung::iec10 {

// By content alone: the root element is in the namespace of the standard.
bool isIec10(std::string_view text);

// The program in `file`, as a separate file. No file: an error has been reported.
FileId readProject(Sources& sources, FileId file, Diagnostics& diagnostics);

}  // namespace rung::iec10
