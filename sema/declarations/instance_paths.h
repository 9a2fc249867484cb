// SPDX-License-Identifier: Apache-2.0
// Variables of single instances: open addresses (AT %I*) and VAR_CONFIG. In: the project, every POU resolved, every
// body checked. Out: addresses of the variables that are views of the image, and Project::instance_paths for those that
// live in an instance. Called once by check().
#pragma once

#include "sema/context.h"

namespace rung::sema {

// IEC 61131-3 ed. 3, 6.5.5.4 and 6.8.1; manual 4.1.1. In codesys an address that VAR_CONFIG does not complete is
// allocated after the last address of its area that the project uses.
void resolveInstancePaths(Context& context);

}  // namespace rung::sema
