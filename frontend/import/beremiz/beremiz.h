// Extensions of Beremiz projects in Python and C, `pyfile.xml` and `cfile.xml`: the variables that they share with the
// PLC. In: a source file with the root <PyFile> or <CFile>. Out: a VAR_GLOBAL with its <variables>, which the programs
// of the project reach by VAR_EXTERNAL. The code of the extension is not read. A row of the table of formats.
#pragma once

#include <string_view>

#include "frontend/import/formats.h"

namespace rung::importer::beremiz {

bool isExtension(std::string_view text);  // by content alone

FileId readProgram(ReadContext& context, FileId file);

}  // namespace rung::importer::beremiz
