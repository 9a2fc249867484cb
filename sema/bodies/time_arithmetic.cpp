// SPDX-License-Identifier: Apache-2.0
// Arithmetic on times and dates: TIME * INT, TIME / REAL, DT - DT, TOD + TIME … (IEC 61131-3 ed. 3 table 35).
// In: a BinaryExpr with a time or date on one side. Out: the same as arithmetic on integers of the type's own unit,
// with conversions at both ends, so that lowering and the kernel know one kind of arithmetic.
// TIME and TOD count milliseconds, DATE and DT seconds, the L forms nanoseconds.
#include "sema/bodies/time_arithmetic.h"

#include "sema/bodies/conversions.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/literals.h"
#include "sema/diagnostics.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

using types::TypeTable;

bool isLong(TypeKind k) { return TypeTable::bitWidth(k) == 64; }
bool isSeconds(TypeKind k) { return k == TypeKind::Date || k == TypeKind::DateTime; }
TypeId durationFor(TypeKind k) { return isLong(k) ? types::kLTime : types::kTime; }

// The integer type that counts this type's units.
TypeId counter(const Context& context, TypeKind k) {
  if (context.types().isSigned(k)) return isLong(k) ? types::kLInt : types::kDInt;
  return isLong(k) ? types::kULInt : types::kUDInt;
}

ExprId converted(Context& context, ExprId expr, TypeId to) {
  if (context.type(expr) != to) wrapConvert(context, expr, to);
  return expr;
}

// A duration as a count of the units of `type` (a date, a time of day, or a duration).
ExprId spanIn(Context& context, ExprId span, TypeKind kind, Loc loc) {
  span = converted(context, span, durationFor(kind));
  const TypeId units = counter(context, kind);
  const TypeId count = counter(context, context.types().kind(durationFor(kind)));
  span = converted(context, span, count);
  if (isSeconds(kind)) {
    span = makeBinary(context, BinaryOp::Divide, span, makeLiteral(context, LiteralKind::Integer, count, 1000, loc),
                      count, loc);
  }
  return converted(context, span, units);
}

// span * number, span / number
TypeId scale(Context& context, ExprId& self, BinaryOp op, ExprId span, ExprId factor, TypeKind kind, Loc loc) {
  const TypeId duration = types::idOf(kind);
  const TypeKind by = context.types().plainKind(context.type(factor));
  if (TypeTable::isReal(by) || by == TypeKind::RealLiteral) {
    if (by == TypeKind::RealLiteral && !adapt(context, factor, types::kLReal, {})) return types::kError;
    span = converted(context, converted(context, span, counter(context, kind)), types::kLReal);
    context.replace(self, makeBinary(context, op, span, converted(context, factor, types::kLReal), types::kLReal, loc));
    // The count is rounded like any REAL.
    self = converted(context, converted(context, self, counter(context, kind)), duration);
    return duration;
  }
  const TypeId units = counter(context, kind);
  if (by == TypeKind::IntegerLiteral) {
    if (!adapt(context, factor, untypedFits(context, factor, units) ? units : defaultType(context, factor), {})) {
      return types::kError;
    }
  } else if (!TypeTable::isInteger(by) && !(TypeTable::isBits(by) && context.profile().bit_arithmetic)) {
    return {};
  }
  if (op == BinaryOp::Divide) {
    if (const auto value = constantInteger(context, factor); value && *value == 0) {
      context.report(diag::DivisionByZero, context.tree().loc(factor));
      return types::kError;
    }
  }
  span = converted(context, span, units);
  context.replace(self, makeBinary(context, op, span, converted(context, factor, units), units, loc));
  self = converted(context, self, duration);
  return duration;
}

// MOD of two durations.
TypeId moduloOfTimes(Context& context, ExprId& self, ExprId left, ExprId right, TypeKind kind, Loc loc) {
  const TypeId units = counter(context, kind);
  context.replace(self, makeBinary(context, BinaryOp::Modulo, spanIn(context, left, kind, loc),
                                   spanIn(context, right, kind, loc), units, loc));
  self = converted(context, self, types::idOf(kind));
  return types::idOf(kind);
}

// The difference of two dates or times of day. None: they have no common type.
TypeId subtractDates(Context& context, ExprId& self, ExprId left, ExprId right, Loc loc) {
  const TypeKind a = context.types().plainKind(context.type(left));
  const TypeKind b = context.types().plainKind(context.type(right));
  const bool same_quantity = TypeTable::isTimeOfDay(a) == TypeTable::isTimeOfDay(b) && isLong(a) != isLong(b);
  if (a != b && !same_quantity) return {};
  const TypeKind kind = isLong(a) ? a : b;
  left = converted(context, left, types::idOf(kind));
  right = converted(context, right, types::idOf(kind));
  const TypeId units = counter(context, kind);
  const TypeId span = durationFor(kind);
  const TypeId count = counter(context, context.types().kind(span));
  ExprId difference = makeBinary(context, BinaryOp::Subtract, converted(context, left, units),
                                 converted(context, right, units), units, loc);
  difference = converted(context, difference, count);
  if (isSeconds(kind)) {
    difference = makeBinary(context, BinaryOp::Multiply, difference,
                            makeLiteral(context, LiteralKind::Integer, count, 1000, loc), count, loc);
  }
  context.replace(self, converted(context, difference, span));
  return span;
}

// A DATE has no time of day to which a duration could be added.
bool hasTimeOfDay(TypeKind k) { return TypeTable::isDate(k) && k != TypeKind::Date && k != TypeKind::LDate; }

}  // namespace

TypeId combineTimes(Context& context, ExprId& self, BinaryOp op, ExprId left, ExprId right) {
  const TypeKind a = context.types().plainKind(context.type(left));
  const TypeKind b = context.types().plainKind(context.type(right));
  const Loc loc = context.tree().loc(self);
  const bool span_left = TypeTable::isDuration(a), span_right = TypeTable::isDuration(b);
  if (op == BinaryOp::Multiply) {
    if (span_left && !span_right && !TypeTable::isDate(b)) return scale(context, self, op, left, right, a, loc);
    if (span_right && !span_left && !TypeTable::isDate(a)) return scale(context, self, op, right, left, b, loc);
    return {};
  }
  if (op == BinaryOp::Divide) {
    if (span_left && !span_right && !TypeTable::isDate(b)) return scale(context, self, op, left, right, a, loc);
    return {};
  }
  if (op == BinaryOp::Modulo && span_left && span_right && context.profile().modulo_of_times)
    return moduloOfTimes(context, self, left, right, isLong(a) || isLong(b) ? TypeKind::LTime : TypeKind::Time, loc);
  if (op != BinaryOp::Add && op != BinaryOp::Subtract) return {};
  if (span_left && span_right) {
    const TypeId type = isLong(a) || isLong(b) ? types::kLTime : types::kTime;
    BinaryExpr& node = context.code().as<BinaryExpr>(self);
    node.left = converted(context, left, type);
    node.right = converted(context, right, type);
    return type;
  }
  if (hasTimeOfDay(a) && span_right) {
    const TypeId units = counter(context, a);
    context.replace(
        self, makeBinary(context, op, converted(context, left, units), spanIn(context, right, a, loc), units, loc));
    self = converted(context, self, types::idOf(a));
    return types::idOf(a);
  }
  if (op == BinaryOp::Add && span_left && hasTimeOfDay(b)) {
    const TypeId units = counter(context, b);
    context.replace(
        self, makeBinary(context, op, spanIn(context, left, b, loc), converted(context, right, units), units, loc));
    self = converted(context, self, types::idOf(b));
    return types::idOf(b);
  }
  if (op == BinaryOp::Subtract && TypeTable::isDate(a) && TypeTable::isDate(b))
    return subtractDates(context, self, left, right, loc);
  return {};
}

}  // namespace rung::sema
