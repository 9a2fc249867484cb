// SPDX-License-Identifier: Apache-2.0
// Warns of locals that hide globals of the project; see hidden_globals.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkHiddenGlobals(Context& context);

}  // namespace rung::sema
