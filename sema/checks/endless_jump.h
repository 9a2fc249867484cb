// SPDX-License-Identifier: Apache-2.0
// Warns of jumps back from which nothing leaves; see endless_jump.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkEndlessJumps(Context& context);

}  // namespace rung::sema
