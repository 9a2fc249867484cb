// SPDX-License-Identifier: Apache-2.0
// The check of a project: declarations, bodies and rules (declarations/, bodies/, checks/), in this order. Called by
// the tools once for each project.
#pragma once

#include <vector>

#include "sema/bodies/constant_cams.h"
#include "sema/project.h"

namespace rung::sema {

// A context at file level, with which a tool resolves single declarations; `scopes` is empty and outlives it.
Context contextOf(Project& project, Scopes& scopes);

// Checks the whole project: collects the declarations of tree.files, resolves types and layout, checks every body,
// resolves libraries on demand. Errors go to project.diagnostics. Bodies of library POUs are checked when used.
// Afterwards each expression of a checked body has its type, implicit conversions are ConvertExpr nodes, untyped
// literals have their context's type, and project.pous lists user POUs and the library POUs in use.
void check(Project& project);

// For pictures: the pins of boxes that are in-outs of what they call, by their index in the tree. Collects and resolves
// declarations as check() does; bodies stay as parsed.
std::vector<bool> inOutsOfBoxes(Project& project);

// The cams whose table the source declares, after check().
std::vector<ConstantCam> constantCams(Project& project);

}  // namespace rung::sema
