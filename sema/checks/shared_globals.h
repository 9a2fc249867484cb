// SPDX-License-Identifier: Apache-2.0
// Warns of globals that two tasks write; see shared_globals.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkSharedGlobals(Context& context);

}  // namespace rung::sema
