// SPDX-License-Identifier: Apache-2.0
// Conversions in C++. In: a Convert expression. Out: C++ that agrees with the arithmetic kernel: reals are rounded,
// subranges clamped, times scaled. Called by expressions.cpp.
#include "codegen/body_parts.h"

namespace rung::codegen {

using types::TypeInfo;
using types::TypeTable;

void ExpressionWriter::convertTime(ExprId from, TypeKind source, TypeKind target) {
  const bool is_signed = types_.isSigned(source);
  const char* integer = is_signed ? "(int64_t)" : "(uint64_t)";
  const char* suffix = is_signed ? "LL" : "ULL";
  const int64_t unit = types::nanoseconds(source), to = types::nanoseconds(target);
  constexpr int64_t kDay = 86'400'000'000'000;
  // Computed in the finer of both units: 32-bit values scaled up fit 64 bits.
  auto number = [&] {
    out_ += integer;
    value(from, Prec::Unary);
  };
  const int64_t day = kDay / unit;
  out_ += '(';
  if (TypeTable::isDateTime(source) && TypeTable::isTimeOfDay(target)) {
    number();
    out_ += " % ";
    appendSigned(out_, day);
    out_ += suffix;
  } else if (TypeTable::isDateTime(source) && TypeTable::isDay(target)) {
    number();
    out_ += " / ";
    appendSigned(out_, day);
    out_ += suffix;
    out_ += " * ";
    appendSigned(out_, day);
    out_ += suffix;
  } else {
    number();
  }
  out_ += ')';
  if (unit > to) {
    out_ += " * ";
    appendSigned(out_, unit / to);
    out_ += suffix;
  } else if (to > unit) {
    out_ += " / ";
    appendSigned(out_, to / unit);
    out_ += suffix;
  }
}

void ExpressionWriter::convert(ExprId id, Prec context) {
  const Expr& e = expr(id);
  const ExprId from = e.as<ir::ConvertExpr>().operand;
  const TypeKind target = types_.plainKind(e.type);
  if (TypeTable::isString(target)) {
    strings().stringValue(id);
    return;
  }
  const TypeInfo& info = types_.info(types_.resolve(e.type));
  if (e.proven != 0 && widthOf(target) < 32 && (widthOf(kindOf(from)) < 32 || kindOf(from) == TypeKind::DInt)) {
    value(from, context);  // an int
    return;
  }
  if (info.kind != TypeKind::Subrange || types_.resolve(expr(from).type) == types_.resolve(e.type)) {
    convertScalar(e.type, e.as<ir::ConvertExpr>(), context);
    return;
  }
  const bool fits_signed = types_.isSigned(target) || widthOf(target) < 64;
  const TypeId limits = fits_signed ? types::kLInt : types::kULInt;
  parenthesis(Prec::Unary, context);
  out_ += '(';
  out_ += scalarType(types_, e.type);
  out_ += fits_signed ? ")rung_clamp(" : ")rung_clamp_u(";
  convertScalar(e.type, e.as<ir::ConvertExpr>(), Prec::Ternary);
  out_ += ", ";
  appendConstant(out_, types_, limits, static_cast<uint64_t>(info.low));
  out_ += ", ";
  appendConstant(out_, types_, limits, static_cast<uint64_t>(info.high));
  out_ += ')';
  closeParenthesis(Prec::Unary, context);
}

void ExpressionWriter::convertScalar(TypeId type, const ir::ConvertExpr& node, Prec context) {
  const ExprId from = node.operand;
  const TypeKind source = kindOf(from), target = types_.plainKind(type);
  if (TypeTable::isString(source)) {
    scalarOfString(type, from, context);
  } else if (isPointer(target) || isPointer(source)) {
    if (isPointer(target) == isPointer(source)) {
      value(from, context);
    } else {
      cast(isPointer(target) ? "void*" : scalarType(types_, type), context, [&] {
        out_ += "(uintptr_t)";
        value(from, Prec::Unary);
      });
    }
  } else if (TypeTable::isReal(target)) {
    if (source == target) {
      value(from, context);
    } else {
      cast(scalarType(types_, type), context, [&] { value(from, Prec::Unary); });
    }
  } else if (target == TypeKind::Bool) {
    truthOf(from, context);
  } else if (TypeTable::isReal(source)) {
    roundReal(type, from, node.rounding, context);
  } else if (types::changesUnit(source, target)) {
    cast(scalarType(types_, type), context, [&] {
      out_ += '(';
      convertTime(from, source, target);
      out_ += ')';
    });
  } else {
    resizeInteger(type, from, context);
  }
}

// `(type)` and what f writes.
template <class F>
void ExpressionWriter::cast(std::string_view type, Prec context, F&& f) {
  parenthesis(Prec::Unary, context);
  out_ += '(';
  out_ += type;
  out_ += ')';
  f();
  closeParenthesis(Prec::Unary, context);
}

void ExpressionWriter::scalarOfString(TypeId type, ExprId from, Prec context) {
  const TypeKind target = types_.plainKind(type);
  auto bits = [&] {
    out_ += kindOf(from) == TypeKind::WString ? "rung_scalar_of_wstring(" : "rung_scalar_of_string(";
    out_ += typeKindName(types_, type);
    out_ += ", ";
    strings().stringValue(from);
    out_ += ')';
  };
  if (!TypeTable::isReal(target)) {
    cast(scalarType(types_, type), context, bits);
    return;
  }
  if (target == TypeKind::Real) out_ += "(float)";
  out_ += "rung_f64_of(";
  bits();
  out_ += ')';
}

void ExpressionWriter::truthOf(ExprId from, Prec context) {
  const TypeKind source = kindOf(from);
  if (source == TypeKind::Bool) {
    value(from, context);
  } else if (TypeTable::isReal(source)) {  // FALSE for NaN
    out_ += '(';
    value(from, Prec::Sum);
    out_ += " < 0 || ";
    value(from, Prec::Sum);
    out_ += " > 0)";
  } else {
    parenthesis(Prec::Equality, context);
    value(from, Prec::Sum);
    out_ += " != 0";
    closeParenthesis(Prec::Equality, context);
  }
}

void ExpressionWriter::roundReal(TypeId type, ExprId from, types::Rounding rounding, Prec context) {
  if (rounding == types::Rounding::AwayFromZero) {
    cast(scalarType(types_, type), context, [&] {
      out_ += "rung_whole(";
      value(from, Prec::Ternary);
      out_ += ')';
    });
    return;
  }
  const TypeKind target = types_.plainKind(type);
  const bool is_signed = types_.isSigned(target);
  const uint32_t width = widthOf(target);
  if (width == 64 || (width == 32 && is_signed)) {
    out_ += width == 32 ? "rung_round_i32(" : is_signed ? "rung_round_i64(" : "rung_round_u64(";
    value(from, Prec::Ternary);
    out_ += ')';
    return;
  }
  cast(scalarType(types_, type), context, [&] {
    out_ += "rung_round(";
    value(from, Prec::Ternary);
    out_ += ", ";
    appendSigned(out_, is_signed ? -(int64_t{1} << (width - 1)) : 0);
    out_ += ", ";
    appendSigned(out_, (int64_t{1} << (is_signed ? width - 1 : width)) - 1);
    out_ += ')';
  });
}

void ExpressionWriter::resizeInteger(TypeId type, ExprId from, Prec context) {
  const TypeKind source = kindOf(from), target = types_.plainKind(type);
  const bool from_signed = types_.isSigned(source), is_signed = types_.isSigned(target);
  const uint32_t from_width = widthOf(source), width = widthOf(target);
  // The value promotes to int, which is the target's type or can hold it.
  const bool keeps =
      (from_width == width && from_signed == is_signed && from_width > 1) ||
      (from_width < 32 && width <= 32 && from_width < width && (is_signed || (!from_signed && width < 32)));
  if (keeps) {
    value(from, context);
    return;
  }
  cast(scalarType(types_, type), context, [&] {
    if (isChain(expr(from)) && from_width >= width && width < 64) {  // the operand need not be cut first
      out_ += '(';
      inPlainOrModular(from, from_width);
      out_ += ')';
    } else {
      value(from, Prec::Unary);
    }
  });
}

}  // namespace rung::codegen
