// A toy: declarations, a line `---`, and a rung per line: `a /b = lamp`.
#pragma once

#include "frontend/import/formats.h"

namespace rung::importer::rungs {

bool isRungs(std::string_view text);
FileId readProgram(ReadContext& context, FileId file);

}  // namespace rung::importer::rungs
