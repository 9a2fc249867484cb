// SPDX-License-Identifier: Apache-2.0
// Constant expressions, evaluated by the arithmetic kernel; see constants.cpp.
#pragma once

#include <optional>

#include "sema/context.h"

namespace rung::sema {

// The value of an expression that was checked, when it is constant (literals, constants, operators on them,
// conversions, SIZEOF). Faults in it (1/0, overflow) are reported once.
std::optional<types::Value> evaluate(Context& context, ExprId expr);
// The same for lowering, which reports nothing, calls no function and makes no string: what needs this has no value.
// The type of the value is resolved.
std::optional<types::Value> constantOf(const Symbols& symbols, ExprId expr);
// The same of an intermediate result (intermediate.h) in its own type.
std::optional<types::Value> uncutConstant(const Symbols& symbols, ExprId expr);
// As evaluate; an expression that is not constant is an error.
std::optional<types::Value> requireConstant(Context& context, ExprId expr, TypeId type);
// A constant integer, as in bounds and lengths; reports an expression that is not one.
std::optional<int64_t> constantBound(Context& context, ExprId& expr);
// The same of an expression as a declaration has it.
std::optional<int64_t> boundAsWritten(Context& context, ExprId written);

}  // namespace rung::sema
