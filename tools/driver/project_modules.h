// SPDX-License-Identifier: Apache-2.0
// The sections [module NAME] of rung.project: the I/O modules of the machine. In: the sections. Out: the modules with
// the place of their channels, and the channels as variables of a namespace of the module's name, in ST mapped to the
// file. Called by project_file.cpp.
#pragma once

#include "tools/driver/project_file.h"

namespace rung::driver {

void readModules(Sources& sources, Diagnostics& diagnostics, ProjectFile& project);

// A section's entry whose value is wrong, and why.
void badValue(Diagnostics& diagnostics, const ProjectEntry& entry, std::string_view why);

}  // namespace rung::driver
