// SPDX-License-Identifier: Apache-2.0
// A project's own POUs for implicit checks, as CODESYS and TwinCAT call them: CheckBounds for array indices,
// CheckDivDInt and its kin for divisors, CheckRangeSigned and its kin for subranges, CheckPointer for `^`; see
// implicit_checks.cpp.
#pragma once

#include "sema/access.h"
#include "sema/context.h"

namespace rung::sema {

void callBoundsCheck(Context& context, ExprId& index, const types::Dimension& dimension);
void callDivisorCheck(Context& context, ExprId& divisor);
void callRangeCheck(Context& context, ExprId& value, TypeId subrange);
void callPointerCheck(Context& context, ExprId& pointer, TypeId target, Access access);

}  // namespace rung::sema
