// SPDX-License-Identifier: Apache-2.0
// Expressions: dispatch over the kinds, and those that are not names, literals, operators or calls; see
// expressions.cpp.
#pragma once

#include <optional>

#include "sema/access.h"
#include "sema/context.h"

namespace rung::sema {

// Checks an expression and returns its type (kError after a report). `expected` (or none) is the type that the context
// wants: it types literals and picks enumeration items; nothing is converted. May replace the expression.
TypeId checkExpr(Context& context, ExprId& expr, TypeId expected = {});
TypeId check(Context& context, ExprId& expr, TypeId expected, Access access);
// The type of a BitAccess whose base was checked. (expressions.cpp)
TypeId checkBitOf(Context& context, ExprId expr);
// The value of a constant integer expression; plain literals are not evaluated. None when it is not constant.
std::optional<int64_t> constantInteger(Context& context, ExprId expr);

}  // namespace rung::sema
