// SPDX-License-Identifier: Apache-2.0
// Warns of a function that never assigns its result; see result_assigned.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkResultAssigned(Context& context);

}  // namespace rung::sema
