// SPDX-License-Identifier: Apache-2.0
// Calls whose names follow a rule instead of a declaration: conversions `<A>_TO_<B>`, `TO_<B>`, `ANY_TO_<B>`,
// `<A>_TRUNC_<B>`, `TRUNC_<B>`, and typed names `<FUNC>_<TYPE>` (MUX_INT, ADD_TIME); see conversion_calls.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// `INT_TO_REAL(x)`, `TO_INT(x)`, `REAL_TRUNC_INT(x)`, `MUX_INT(…)`: names that follow a rule. None for another name.
TypeId checkRuleCall(Context& context, ExprId& expr, NameId name, TypeId expected);
// Turns a call with EN or ENO that means a plain value, a conversion or a sum of times into
// MOVE(EN := …, value, ENO => …): the value has no pins of its own.
TypeId guardValue(Context& context, ExprId& expr, ExprId value);

}  // namespace rung::sema
