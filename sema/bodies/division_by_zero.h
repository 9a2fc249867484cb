// SPDX-License-Identifier: Apache-2.0
// Forbids a division by a constant zero; see division_by_zero.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// False after an error.
bool checkDivisor(Context& context, ExprId divisor, BinaryOp op);

}  // namespace rung::sema
