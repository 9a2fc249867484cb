// SPDX-License-Identifier: Apache-2.0
// The sections [axis NAME] of rung.project: the axes of the machine and their drives. In: the sections. Out: each axis
// as a global variable of type AXIS_REF_SM3 with its initial values, in ST mapped to the file, and, for an axis whose
// drive is in the process image, the block that copies between both. Called by project_file.cpp.
#pragma once

#include "tools/driver/project_file.h"

namespace rung::driver {

void readAxes(Sources& sources, Diagnostics& diagnostics, ProjectFile& project);

}  // namespace rung::driver
