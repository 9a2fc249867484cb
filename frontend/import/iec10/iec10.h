// SPDX-License-Identifier: Apache-2.0
// Projects in the XML of IEC 61131-10:2019, which succeeds PLCopen TC6, as written by Sysmac Studio, GX Works3, nodalis
// and others, and single POUs in it. In: a source file. Out: source-mapped text that the ST parser reads, with
// locations in that file, in the order described in frontend/import/plcopen/plcopen.h. docs/files.md lists the
// supported elements. A row of the table of formats.
#pragma once

#include <string_view>

#include "frontend/import/formats.h"

namespace rung::importer::iec10 {

// By content alone: the root element is in the namespace of the standard.
bool isIec10(std::string_view text);

FileId readProgram(ReadContext& context, FileId file);

}  // namespace rung::importer::iec10
