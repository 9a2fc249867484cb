// SPDX-License-Identifier: Apache-2.0
// Integer arithmetic in C++: sums, products, divisions, shifts and powers. In: an operator of the IR. Out: C++ that
// agrees with the arithmetic kernel. Integers are computed in unsigned types of their width, or in int where no
// intermediate value can leave it, and cut back. Called by expressions.cpp and conversions.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/builder.h"

namespace rung::codegen {

using types::TypeTable;

namespace {

bool isSumOrProduct(types::Op op) { return op == types::Op::Add || op == types::Op::Sub || op == types::Op::Mul; }

}  // namespace

// ---- integer + - * and negation

bool ExpressionWriter::isChain(const Expr& e) const {
  const auto* negation = e.tryAs<ir::UnaryExpr>();
  const auto* binary = e.tryAs<ir::BinaryExpr>();
  const bool is_arithmetic =
      (binary != nullptr && isSumOrProduct(binary->op)) || (negation != nullptr && negation->op == Op::Neg);
  const TypeKind kind = types_.plainKind(e.type);
  return is_arithmetic && widthOf(kind) > 1 && !TypeTable::isReal(kind);
}

// Nothing has to be cut, here or in what it is made of.
bool ExpressionWriter::isUncut(ExprId id) const {
  const Expr& e = expr(id);
  if (!isChain(e)) return true;
  if (e.proven == 0) return false;
  if (const auto* negation = e.tryAs<ir::UnaryExpr>()) return isUncut(negation->operand);
  return isUncut(e.as<ir::BinaryExpr>().left) && isUncut(e.as<ir::BinaryExpr>().right);
}

// Bits of a signed number that holds every value of the expression computed in int.
uint32_t ExpressionWriter::plainBits(ExprId id) const {
  const Expr& e = expr(id);
  if (isChain(e)) {
    if (const auto* negation = e.tryAs<ir::UnaryExpr>()) return plainBits(negation->operand) + 1;
    const auto [left, right, op] = e.as<ir::BinaryExpr>();
    const uint32_t a = plainBits(left), b = plainBits(right);
    return op == Op::Mul ? a + b : std::max(a, b) + 1;
  }
  const TypeKind kind = types_.plainKind(e.type);
  if (e.kind == ExprKind::Const) {
    const auto number = static_cast<int64_t>(ir::bitsOf(e));
    uint32_t bits = 1;
    while (bits < 32 && (number < -(int64_t{1} << (bits - 1)) || number >= int64_t{1} << (bits - 1))) ++bits;
    return bits;
  }
  return widthOf(kind) + (types_.isSigned(kind) ? 0 : 1);
}

void ExpressionWriter::plain(ExprId id, Prec context) {
  const Expr& e = expr(id);
  if (!isChain(e)) {
    value(id, context);
    return;
  }
  if (const auto* negation = e.tryAs<ir::UnaryExpr>()) {
    parenthesis(Prec::Unary, context);
    out_ += '-';
    plain(negation->operand, Prec::Postfix);
    closeParenthesis(Prec::Unary, context);
    return;
  }
  const auto [left, right, op] = e.as<ir::BinaryExpr>();
  const Prec own = op == Op::Mul ? Prec::Product : Prec::Sum;
  parenthesis(own, context);
  plain(left, own);
  out_ += op == Op::Add ? " + " : op == Op::Sub ? " - " : " * ";
  plain(right, own == Prec::Sum ? Prec::Product : Prec::Unary);
  closeParenthesis(own, context);
}

// An unsigned expression of 32 or 64 bits that is equal to the value modulo 2^32 or 2^64.
void ExpressionWriter::modular(ExprId id, bool wide, Prec context) {
  const Expr& e = expr(id);
  const TypeKind kind = types_.plainKind(e.type);
  if (isChain(e)) {
    if (const auto* negation = e.tryAs<ir::UnaryExpr>()) {
      parenthesis(Prec::Sum, context);
      out_ += wide ? "0ULL - " : "0u - ";
      modular(negation->operand, wide, Prec::Product);
      closeParenthesis(Prec::Sum, context);
      return;
    }
    const auto [left, right, op] = e.as<ir::BinaryExpr>();
    const Prec own = op == Op::Mul ? Prec::Product : Prec::Sum;
    parenthesis(own, context);
    modular(left, wide, own);
    const auto* constant = expr(right).tryAs<ir::ConstExpr>();
    const bool flips = own == Prec::Sum && constant != nullptr && types_.isSigned(kind) &&
                       static_cast<int64_t>(uint64_t{constant->bits}) < 0;
    out_ += op == Op::Mul ? " * " : (op == Op::Add) != flips ? " + " : " - ";
    if (flips) {
      appendUnsigned(out_, 0 - uint64_t{constant->bits});
      out_ += wide ? "ULL" : "u";
    } else {
      modular(right, wide, own == Prec::Sum ? Prec::Product : Prec::Unary);
    }
    closeParenthesis(own, context);
    return;
  }
  if (ir::isConst(e)) {
    appendUnsigned(out_, wide ? ir::bitsOf(e) : static_cast<uint32_t>(ir::bitsOf(e)));
    out_ += wide ? "ULL" : "u";
    return;
  }
  if (!types_.isSigned(kind) && widthOf(kind) == (wide ? 64u : 32u)) {
    value(id, context);
    return;
  }
  parenthesis(Prec::Unary, context);
  out_ += wide ? "(uint64_t)" : "(uint32_t)";
  value(id, Prec::Unary);
  closeParenthesis(Prec::Unary, context);
}

void ExpressionWriter::arithmetic(ExprId id, Prec context) {
  const Expr& e = expr(id);
  const auto* binary = e.tryAs<ir::BinaryExpr>();
  const TypeKind kind = kindOf(binary != nullptr ? binary->left : e.as<ir::UnaryExpr>().operand);
  const uint32_t width = widthOf(kind);
  if (binary != nullptr && (isPointer(kind) || width == 0)) {
    parenthesis(Prec::Unary, context);
    out_ += "(void*)((uintptr_t)";
    value(binary->left, Prec::Unary);
    out_ += binary->op == Op::Sub ? " - " : " + ";
    out_ += "(uintptr_t)";
    value(binary->right, Prec::Unary);
    out_ += ')';
    closeParenthesis(Prec::Unary, context);
    return;
  }
  if (!types_.isSigned(kind) && width >= 32) {
    modular(id, width == 64, context);
    return;
  }
  if (isUncut(id) && plainBits(id) <= 32) {
    plain(id, context);
    return;
  }
  parenthesis(Prec::Unary, context);
  out_ += '(';
  out_ += scalarType(types_, e.type);
  out_ += ")(";
  inPlainOrModular(id, width);
  out_ += ')';
  closeParenthesis(Prec::Unary, context);
}

// An operator of that width, to be cut to a type.
void ExpressionWriter::inPlainOrModular(ExprId id, uint32_t width) {
  if (width <= 16 && plainBits(id) <= 32) {
    plain(id, Prec::Comma);
  } else {
    modular(id, width == 64, Prec::Comma);
  }
}

void ExpressionWriter::divide(const ir::BinaryExpr& node, Prec context) {
  const auto [a, b, op] = node;
  const TypeKind kind = kindOf(a);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  const uint64_t divisor = ir::isConst(expr(b)) ? ir::bitsOf(expr(b)) : 0;
  if (divisor != 0 && !(is_signed && static_cast<int64_t>(divisor) == -1)) {
    parenthesis(Prec::Product, context);
    value(a, Prec::Product);
    out_ += op == Op::Div ? " / " : " % ";
    value(b, Prec::Unary);
    closeParenthesis(Prec::Product, context);
    return;
  }
  const bool cuts = is_signed && width < 32 && op == Op::Div;
  if (cuts) {
    parenthesis(Prec::Unary, context);
    out_ += width == 8 ? "(int8_t)" : "(int16_t)";
  }
  out_ += op == Op::Div ? "rung_div_" : "rung_mod_";
  out_ += width == 64 ? (is_signed ? "i64(" : "u64(") : (is_signed || width < 32 ? "i32(" : "u32(");
  value(a, Prec::Ternary);
  out_ += ", ";
  value(b, Prec::Ternary);
  out_ += ')';
  if (cuts) closeParenthesis(Prec::Unary, context);
}

// Filled with the sign; a count of the width or more leaves nothing but the sign.
void ExpressionWriter::shiftSigned(const Expr& e, Prec context) {
  const ExprId a = e.as<ir::BinaryExpr>().left, b = e.as<ir::BinaryExpr>().right;
  const uint32_t width = widthOf(kindOf(a));
  const bool is_constant = expr(b).kind == ExprKind::Const, cuts = width < (is_constant ? 32u : 64u);
  const Prec own = cuts ? Prec::Unary : is_constant ? Prec::Shift : Prec::Postfix;
  parenthesis(own, context);
  if (cuts) {
    out_ += '(';
    out_ += scalarType(types_, e.type);
    out_ += is_constant ? ")(" : ")";
  }
  if (is_constant) {
    value(a, Prec::Unary);
    out_ += " >> ";
    appendUnsigned(out_, std::min<uint64_t>(ir::bitsOf(expr(b)), width - 1));
    if (cuts) out_ += ')';
  } else {
    out_ += "rung_sar(";
    value(a, Prec::Ternary);
    out_ += ", (uint64_t)";
    value(b, Prec::Unary);
    out_ += ')';
  }
  closeParenthesis(own, context);
}

// A count of the width or more gives 0; a rotation is modulo the width.
void ExpressionWriter::shift(const Expr& e, Prec context) {
  const Op op = e.op() == Op::Sar ? Op::Shr : e.op();
  if (e.op() == Op::Sar && types_.isSigned(kindOf(e.as<ir::BinaryExpr>().left))) {
    shiftSigned(e, context);
    return;
  }
  const ExprId a = e.as<ir::BinaryExpr>().left, b = e.as<ir::BinaryExpr>().right;
  const TypeKind kind = kindOf(a);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  auto writeBits = [&](Prec at) {  // zero-extended
    if (!is_signed) {
      value(a, at);
      return;
    }
    parenthesis(Prec::Unary, at);
    out_ += width == 8 ? "(uint8_t)" : width == 16 ? "(uint16_t)" : width == 32 ? "(uint32_t)" : "(uint64_t)";
    value(a, Prec::Unary);
    closeParenthesis(Prec::Unary, at);
  };
  const bool rotates = op == Op::Rol || op == Op::Ror;
  const bool cuts = is_signed || (width < 32 && op == Op::Shl);
  if (!rotates && expr(b).kind == ExprKind::Const) {
    const uint64_t count = ir::bitsOf(expr(b));
    if (count >= width) {
      appendConstant(out_, types_, e.type, 0);
      return;
    }
    parenthesis(cuts ? Prec::Unary : Prec::Shift, context);
    if (cuts) {
      out_ += '(';
      out_ += scalarType(types_, e.type);
      out_ += ")(";
    }
    writeBits(Prec::Unary);
    out_ += op == Op::Shl ? " << " : " >> ";
    appendUnsigned(out_, count);
    if (cuts) out_ += ')';
    closeParenthesis(cuts ? Prec::Unary : Prec::Shift, context);
    return;
  }
  if (cuts) {
    parenthesis(Prec::Unary, context);
    out_ += '(';
    out_ += scalarType(types_, e.type);
    out_ += ')';
  }
  if (rotates) {
    out_ += "rung_rol";
    appendUnsigned(out_, width);
  } else {
    out_ += op == Op::Shl ? "rung_shl" : "rung_shr";
    if (width == 64) out_ += "64";
  }
  out_ += '(';
  writeBits(Prec::Ternary);
  out_ += op == Op::Ror ? ", 0 - (uint64_t)" : ", (uint64_t)";
  value(b, Prec::Unary);
  out_ += ')';
  if (cuts) closeParenthesis(Prec::Unary, context);
}

void ExpressionWriter::power(const Expr& e) {
  const ExprId a = e.as<ir::BinaryExpr>().left, b = e.as<ir::BinaryExpr>().right;
  const TypeKind kind = kindOf(a);
  if (TypeTable::isReal(kind)) {
    if (kind == TypeKind::Real) out_ += "(float)";
    out_ += "rung_power(";
    value(a, Prec::Ternary);
    out_ += ", ";
    if (!TypeTable::isReal(kindOf(b))) out_ += "(double)";
    value(b, TypeTable::isReal(kindOf(b)) ? Prec::Ternary : Prec::Unary);
    out_ += ')';
    return;
  }
  out_ += '(';
  out_ += scalarType(types_, e.type);
  out_ += ")rung_integer_power(";
  out_ += types_.isSigned(kind) ? "(uint64_t)(int64_t)" : "(uint64_t)";
  value(a, Prec::Unary);
  out_ += ", (uint64_t)";
  value(b, Prec::Unary);
  out_ += ", ";
  if (types_.isSigned(kindOf(b))) {
    value(b, Prec::Sum);
    out_ += " < 0)";
  } else {
    out_ += "false)";
  }
}

}  // namespace rung::codegen
