// SPDX-License-Identifier: Apache-2.0
// Forbids POUs that call themselves; see recursion.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkRecursion(Context& context);

}  // namespace rung::sema
