// SPDX-License-Identifier: Apache-2.0
// Operators: the common type of both sides, and the type of the result; see operators.cpp.
#pragma once

#include <span>
#include <string_view>

#include "sema/context.h"

namespace rung::sema {

TypeId checkUnary(Context& context, ExprId& expr, TypeId expected);
TypeId checkBinary(Context& context, ExprId& expr, TypeId expected);
// Both operands are checked: types and converts them and returns the type of the result. `self` is the BinaryExpr,
// which may be replaced (time arithmetic).
TypeId combine(Context& context, ExprId& self, TypeId expected);
// x ** n of checked operands: the base becomes REAL or LREAL, the exponent keeps its type.
TypeId power(Context& context, ExprId& base_expr, ExprId& exponent_expr, TypeId expected, Loc loc);

// The common type of several operands of one operator (ADD, MAX, EQ, MUX …), which are converted to it.
enum class Operands : uint8_t { Number, NumberOrTime, Bits, Comparable, Equatable, Anything };

TypeId unify(Context& context, std::span<ExprId> operands, Operands accepted, TypeId expected, std::string_view what,
             Loc loc);

}  // namespace rung::sema
