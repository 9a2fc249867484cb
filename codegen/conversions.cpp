// SPDX-License-Identifier: Apache-2.0
// Conversions in C++. In: a Convert expression. Out: C++ that agrees with the arithmetic kernel: reals are rounded,
// subranges clamped, times scaled. Called by expressions.cpp.
#include "codegen/body_parts.h"

namespace rung::codegen {

using types::TypeInfo;
using types::TypeTable;

// Computed in the finer of both units: 32-bit values scaled up fit 64 bits.
cxx::Ex ExpressionWriter::convertTime(ExprId from, TypeKind source, TypeKind target) {
  const bool is_signed = types_.isSigned(source);
  const char* const suffix = is_signed ? "LL" : "ULL";
  const int64_t unit = types::nanoseconds(source), to = types::nanoseconds(target);
  constexpr int64_t kDay = 86'400'000'000'000;
  const auto number = [&](int64_t value) { return tree_.number(static_cast<uint64_t>(value), suffix); };
  const Ex day = number(kDay / unit);
  Ex result = tree_.cast(is_signed ? "int64_t" : "uint64_t", value(from));
  if (TypeTable::isDateTime(source) && TypeTable::isTimeOfDay(target)) {
    result = tree_.infix(Operator::Remainder, result, day);
  } else if (TypeTable::isDateTime(source) && TypeTable::isDay(target)) {
    result = tree_.infix(Operator::Multiply, tree_.infix(Operator::Divide, result, day), day);
  }
  result = tree_.group(result);
  if (unit > to) return tree_.infix(Operator::Multiply, result, number(unit / to));
  return to > unit ? tree_.infix(Operator::Divide, result, number(to / unit)) : result;
}

cxx::Ex ExpressionWriter::convert(ExprId id) {
  const Expr& e = expr(id);
  const ir::ConvertExpr& node = e.as<ir::ConvertExpr>();
  const ExprId from = node.operand;
  const TypeKind target = types_.plainKind(e.type);
  if (TypeTable::isString(target)) return strings().stringValue(id);
  const TypeInfo& info = types_.info(types_.resolve(e.type));
  if (e.proven != 0 && widthOf(target) < 32 && (widthOf(kindOf(from)) < 32 || kindOf(from) == TypeKind::DInt))
    return value(from);  // an int
  if (info.kind != TypeKind::Subrange || types_.resolve(expr(from).type) == types_.resolve(e.type))
    return convertScalar(e.type, node);
  const bool fits_signed = types_.isSigned(target) || widthOf(target) < 64;
  const TypeId limits = fits_signed ? types::kLInt : types::kULInt;
  return tree_.cast(scalarType(types_, e.type),
                    tree_.call(fits_signed ? "rung_clamp" : "rung_clamp_u",
                               {convertScalar(e.type, node), constantOf(limits, static_cast<uint64_t>(info.low)),
                                constantOf(limits, static_cast<uint64_t>(info.high))}));
}

cxx::Ex ExpressionWriter::convertScalar(TypeId type, const ir::ConvertExpr& node) {
  const ExprId from = node.operand;
  const TypeKind source = kindOf(from), target = types_.plainKind(type);
  if (TypeTable::isString(source)) return scalarOfString(type, from);
  if (isPointer(target) || isPointer(source)) {
    if (isPointer(target) == isPointer(source)) return value(from);
    return tree_.cast(isPointer(target) ? "void*" : scalarType(types_, type), tree_.cast("uintptr_t", value(from)));
  }
  if (TypeTable::isReal(target)) return source == target ? value(from) : castTo(type, value(from));
  if (target == TypeKind::Bool) return truthOf(from);
  if (TypeTable::isReal(source)) return roundReal(type, from, node.rounding);
  if (types::changesUnit(source, target)) return castTo(type, tree_.group(convertTime(from, source, target)));
  return resizeInteger(type, from);
}

cxx::Ex ExpressionWriter::scalarOfString(TypeId type, ExprId from) {
  const TypeKind target = types_.plainKind(type);
  const Ex bits = tree_.call(kindOf(from) == TypeKind::WString ? "rung_scalar_of_wstring" : "rung_scalar_of_string",
                             {tree_.fixed(typeKindName(types_, type)), strings().stringValue(from)});
  if (!TypeTable::isReal(target)) return castTo(type, bits);
  const Ex real = tree_.call("rung_f64_of", {bits});
  return target == TypeKind::Real ? tree_.cast("float", real) : real;
}

cxx::Ex ExpressionWriter::truthOf(ExprId from) {
  const TypeKind source = kindOf(from);
  const Ex number = value(from);
  if (source == TypeKind::Bool) return number;
  const Ex zero = tree_.number(0);
  if (!TypeTable::isReal(source)) return tree_.infix(Operator::Differs, number, zero);
  const Ex below = tree_.infix(Operator::Less, number, zero), above = tree_.infix(Operator::Greater, number, zero);
  return tree_.group(tree_.infix(Operator::Or, below, above));  // FALSE for NaN
}

cxx::Ex ExpressionWriter::roundReal(TypeId type, ExprId from, types::Rounding rounding) {
  const Ex real = value(from);
  if (rounding == types::Rounding::AwayFromZero) return castTo(type, tree_.call("rung_whole", {real}));
  const TypeKind target = types_.plainKind(type);
  const bool is_signed = types_.isSigned(target);
  const uint32_t width = widthOf(target);
  if (width == 64 || (width == 32 && is_signed)) {
    return tree_.call(width == 32 ? "rung_round_i32" : is_signed ? "rung_round_i64" : "rung_round_u64", {real});
  }
  const int64_t low = is_signed ? -(int64_t{1} << (width - 1)) : 0;
  const int64_t high = (int64_t{1} << (is_signed ? width - 1 : width)) - 1;
  return castTo(type, tree_.call("rung_round", {real, tree_.signedNumber(low), tree_.signedNumber(high)}));
}

cxx::Ex ExpressionWriter::resizeInteger(TypeId type, ExprId from) {
  const TypeKind source = kindOf(from), target = types_.plainKind(type);
  const bool from_signed = types_.isSigned(source), is_signed = types_.isSigned(target);
  const uint32_t from_width = widthOf(source), width = widthOf(target);
  // The value promotes to int, which is the target's type or can hold it.
  const bool keeps =
      (from_width == width && from_signed == is_signed && from_width > 1) ||
      (from_width < 32 && width <= 32 && from_width < width && (is_signed || (!from_signed && width < 32)));
  if (keeps) return value(from);
  const bool is_uncut = isChain(expr(from)) && from_width >= width && width < 64;  // the operand need not be cut first
  return castTo(type, is_uncut ? tree_.group(plainOrModular(from, from_width)) : value(from));
}

}  // namespace rung::codegen
