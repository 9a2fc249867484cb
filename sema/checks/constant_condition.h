// SPDX-License-Identifier: Apache-2.0
// Warns of an IF on a literal; see constant_condition.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkConstantCondition(Context& context, ExprId condition);

}  // namespace rung::sema
