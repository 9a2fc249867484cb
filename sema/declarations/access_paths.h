// SPDX-License-Identifier: Apache-2.0
// VAR_ACCESS: names under which the host finds single variables; see access_paths.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// VAR_ACCESS, when all instances are laid out. (access_paths.cpp)
void resolveAccessPaths(Context& context);

}  // namespace rung::sema
