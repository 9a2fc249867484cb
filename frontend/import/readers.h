// One reader for each format; see readProgram() of vendor.h. Private to frontend/import.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::vendor {

FileId readTwinCat(Sources& sources, FileId file, Diagnostics& diagnostics);
FileId readCodesys2(Sources& sources, FileId file, Diagnostics& diagnostics);
FileId readMultiprog(Sources& sources, FileId file, Diagnostics& diagnostics);

}  // namespace rung::vendor
