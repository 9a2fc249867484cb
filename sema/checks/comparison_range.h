// SPDX-License-Identifier: Apache-2.0
// Warns of comparisons that the type of an operand decides; see comparison_range.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

// Of sides that have one type now, and so may be converted.
void checkComparisonRange(Context& context, types::Op op, ExprId left, ExprId right, Loc loc);

}  // namespace rung::sema
