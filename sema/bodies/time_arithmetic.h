// SPDX-License-Identifier: Apache-2.0
// Arithmetic on times and dates: TIME * INT, TIME / REAL, DT - DT, TOD + TIME … (IEC 61131-3 ed. 3 table 35); see
// time_arithmetic.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// TIME * INT, DT - DT, TOD + TIME …: rewritten as arithmetic on integers. None when the types do not combine this way.
TypeId combineTimes(Context& context, ExprId& self, BinaryOp op, ExprId left, ExprId right);

}  // namespace rung::sema
