// SPDX-License-Identifier: Apache-2.0
// Literals; see literals.cpp.
#pragma once

#include "sema/bodies/conversions.h"
#include "sema/context.h"
#include "sema/shorthands.h"

namespace rung::sema {

inline bool isUntyped(const Context& context, TypeId type) {
  const TypeKind kind = context.types().info(type).kind;
  return kind == TypeKind::IntegerLiteral || kind == TypeKind::RealLiteral;
}

// Types a literal without a prefix, of a character or string, like `wanted`, if its quotes allow that.
void retypeString(Context& context, ExprId& expr, TypeId wanted);
TypeId checkLiteral(Context& context, ExprId& expr, TypeId expected);
// The type of an untyped expression whose context gives it none: INT, DINT, LINT, ULINT; REAL.
TypeId defaultType(Context& context, ExprId expr);
// The value of an untyped integer expression; false when it is too large or not known.
bool untypedValue(const Context& context, ExprId expr, __int128& value);
// Reports a constant outside of a subrange, an error in iec.
bool isInSubrange(Context& context, ExprId expr, __int128 value, TypeId subrange);
// True when the untyped integer fits the type without a message.
bool untypedFits(Context& context, ExprId expr, TypeId to);
// Gives an untyped expression a type; reports a value that does not fit.
bool adapt(Context& context, ExprId& expr, TypeId to, const Purpose& purpose);

// Gives it its default type, or the expected one where that is a number.
TypeId finalizeUntyped(Context& context, ExprId& expr, TypeId expected = {});

}  // namespace rung::sema
