// SPDX-License-Identifier: Apache-2.0
// The reader of `.cam` files (docs/cam.md): one key or row on a line. In: the text of a file. Out: a cam, all mistakes
// reported; for a project, its variables in ST. A row of the table of formats; `rung cam` reads files with it too.
#pragma once

#include "cam/design/cam.h"
#include "frontend/import/formats.h"

namespace rung::importer::cams {

// Where its name and its limits are.
struct CamSource {
  Loc name, position, velocity, acceleration, jerk;
};

// False: errors have been reported.
[[nodiscard]] bool readCam(const Sources& sources, FileId file, Diagnostics& diagnostics, cam::Cam& cam,
                           CamSource* places = nullptr);

// The cam as VAR_GLOBAL.
FileId readProgram(ReadContext& context, FileId file);

}  // namespace rung::importer::cams
