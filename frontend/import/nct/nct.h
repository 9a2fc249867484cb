// SPDX-License-Identifier: Apache-2.0
// The ladder of NCT's machine-tool controls (.nct, docs/nct.md): a row of the table of formats.
#pragma once

#include "frontend/import/formats.h"

namespace rung::importer::nct {

FileId readProgram(ReadContext& context, FileId file);

}  // namespace rung::importer::nct
