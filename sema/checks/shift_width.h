// SPDX-License-Identifier: Apache-2.0
// Warns of shifts that leave nothing; see shift_width.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkShiftWidth(Context& context, ExprId value, ExprId count);

}  // namespace rung::sema
