// SPDX-License-Identifier: Apache-2.0
// Extensions of projects of Beremiz and OpenPLC, each in a folder `NAME@TYPE`: the variables that they share with the
// PLC. In: a source file with the root <PyFile> or <CFile>, or with the root <BaseParams>, which says the channel of
// any extension. Out: a VAR_GLOBAL that the programs of the project reach by VAR_EXTERNAL. The code of the extension is
// not read. Rows of the table of formats.
#pragma once

#include <string_view>

#include "frontend/import/formats.h"

namespace rung::importer::beremiz {

// By content alone.
bool isProject(std::string_view text);
bool isExtension(std::string_view text);

FileId readProgram(ReadContext& context, FileId file);

}  // namespace rung::importer::beremiz
