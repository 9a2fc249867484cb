// SPDX-License-Identifier: Apache-2.0
// Operators in call form: ADD(a, b, c), SEL, MUX, MOVE, SHL … (library functions declared with {operator '…'}, which
// names an operator of the arithmetic kernel); see operator_calls.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

TypeId checkOperatorCall(Context& context, ExprId& expr, PouId pou, TypeId expected, TypeId forced);

}  // namespace rung::sema
