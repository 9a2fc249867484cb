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
cxx::Op operatorOf(types::Op op) {
  return op == types::Op::Add ? cxx::Op::Add : op == types::Op::Sub ? cxx::Op::Subtract : cxx::Op::Multiply;
}

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

cxx::Ex ExpressionWriter::plain(ExprId id) {
  const Expr& e = expr(id);
  if (!isChain(e)) return value(id);
  if (const auto* negation = e.tryAs<ir::UnaryExpr>()) return tree_.prefix("-", plain(negation->operand));
  const auto [left, right, op] = e.as<ir::BinaryExpr>();
  const Ex a = plain(left), b = plain(right);
  return tree_.infix(operatorOf(op), a, b);
}

// An unsigned expression of 32 or 64 bits that is equal to the value modulo 2^32 or 2^64.
cxx::Ex ExpressionWriter::modular(ExprId id, bool wide) {
  const Expr& e = expr(id);
  const TypeKind kind = types_.plainKind(e.type);
  const char* const suffix = wide ? "ULL" : "u";
  if (isChain(e)) {
    if (const auto* negation = e.tryAs<ir::UnaryExpr>())
      return tree_.infix(Operator::Subtract, tree_.number(0, suffix), modular(negation->operand, wide));
    const auto [left, right, op] = e.as<ir::BinaryExpr>();
    const Ex a = modular(left, wide);
    const auto* constant = expr(right).tryAs<ir::ConstExpr>();
    const bool flips = op != Op::Mul && constant != nullptr && types_.isSigned(kind) &&
                       static_cast<int64_t>(uint64_t{constant->bits}) < 0;
    if (flips) {
      return tree_.infix(op == Op::Add ? Operator::Subtract : Operator::Add, a,
                         tree_.number(0 - uint64_t{constant->bits}, suffix));
    }
    return tree_.infix(operatorOf(op), a, modular(right, wide));
  }
  if (ir::isConst(e)) return tree_.number(wide ? ir::bitsOf(e) : static_cast<uint32_t>(ir::bitsOf(e)), suffix);
  if (!types_.isSigned(kind) && widthOf(kind) == (wide ? 64u : 32u)) return value(id);
  return tree_.cast(wide ? "uint64_t" : "uint32_t", value(id));
}

cxx::Ex ExpressionWriter::arithmetic(ExprId id) {
  const Expr& e = expr(id);
  const auto* binary = e.tryAs<ir::BinaryExpr>();
  const TypeKind kind = kindOf(binary != nullptr ? binary->left : e.as<ir::UnaryExpr>().operand);
  const uint32_t width = widthOf(kind);
  if (binary != nullptr && (isPointer(kind) || width == 0)) {
    const Ex left = tree_.cast("uintptr_t", value(binary->left)), right = tree_.cast("uintptr_t", value(binary->right));
    return tree_.cast("void*", tree_.infix(binary->op == Op::Sub ? Operator::Subtract : Operator::Add, left, right));
  }
  if (!types_.isSigned(kind) && width >= 32) return modular(id, width == 64);
  if (isUncut(id) && plainBits(id) <= 32) return plain(id);
  return tree_.cast(scalarType(types_, e.type), tree_.group(plainOrModular(id, width)));
}

// An operator of that width, to be cut to a type.
cxx::Ex ExpressionWriter::plainOrModular(ExprId id, uint32_t width) {
  return width <= 16 && plainBits(id) <= 32 ? plain(id) : modular(id, width == 64);
}

cxx::Ex ExpressionWriter::divide(const ir::BinaryExpr& node) {
  const TypeKind kind = kindOf(node.left);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind), divides = node.op == Op::Div;
  const uint64_t divisor = ir::isConst(expr(node.right)) ? ir::bitsOf(expr(node.right)) : 0;
  if (divisor != 0 && !(is_signed && static_cast<int64_t>(divisor) == -1))
    return both(divides ? Operator::Divide : Operator::Remainder, node);
  std::string name = divides ? "rung_div_" : "rung_mod_";
  name += width == 64 ? (is_signed ? "i64" : "u64") : (is_signed || width < 32 ? "i32" : "u32");
  const Ex result = function(name, node);
  const bool cuts = is_signed && width < 32 && divides;
  return cuts ? tree_.cast(width == 8 ? "int8_t" : "int16_t", result) : result;
}

// Filled with the sign; a count of the width or more leaves nothing but the sign.
cxx::Ex ExpressionWriter::shiftSigned(const Expr& e) {
  const ExprId a = e.as<ir::BinaryExpr>().left, b = e.as<ir::BinaryExpr>().right;
  const uint32_t width = widthOf(kindOf(a));
  const bool is_constant = expr(b).kind == ExprKind::Const;
  Ex result = value(a);
  if (is_constant) {
    const uint64_t count = std::min<uint64_t>(ir::bitsOf(expr(b)), width - 1);
    result = tree_.infix(Operator::ShiftRight, result, tree_.number(count));
  } else {
    result = tree_.call("rung_sar", {result, tree_.cast("uint64_t", value(b))});
  }
  return width < (is_constant ? 32u : 64u) ? tree_.cast(scalarType(types_, e.type), result) : result;
}

// A count of the width or more gives 0; a rotation is modulo the width.
cxx::Ex ExpressionWriter::shift(const Expr& e) {
  const Op op = e.op() == Op::Sar ? Op::Shr : e.op();
  const ExprId a = e.as<ir::BinaryExpr>().left, b = e.as<ir::BinaryExpr>().right;
  const TypeKind kind = kindOf(a);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  if (e.op() == Op::Sar && is_signed) return shiftSigned(e);
  const bool rotates = op == Op::Rol || op == Op::Ror;
  const bool is_constant = !rotates && expr(b).kind == ExprKind::Const;
  if (is_constant && ir::bitsOf(expr(b)) >= width) return constantOf(e.type, 0);
  Ex result = value(a);  // zero-extended
  if (is_signed) result = tree_.cast(unsignedType(width), result);
  if (is_constant) {
    result = tree_.infix(op == Op::Shl ? Operator::ShiftLeft : Operator::ShiftRight, result,
                         tree_.number(ir::bitsOf(expr(b))));
  } else {
    Ex count = tree_.cast("uint64_t", value(b));
    if (op == Op::Ror) count = tree_.infix(Operator::Subtract, tree_.number(0), count);
    const std::string name = rotates         ? "rung_rol" + std::to_string(width)
                             : op == Op::Shl ? width == 64 ? "rung_shl64" : "rung_shl"
                             : width == 64   ? "rung_shr64"
                                             : "rung_shr";
    result = tree_.call(name, {result, count});
  }
  const bool cuts = is_signed || (width < 32 && op == Op::Shl);
  return cuts ? tree_.cast(scalarType(types_, e.type), result) : result;
}

cxx::Ex ExpressionWriter::power(const Expr& e) {
  const ExprId a = e.as<ir::BinaryExpr>().left, b = e.as<ir::BinaryExpr>().right;
  const TypeKind kind = kindOf(a);
  Ex base = value(a), exponent = value(b);
  if (TypeTable::isReal(kind)) {
    if (!TypeTable::isReal(kindOf(b))) exponent = tree_.cast("double", exponent);
    const Ex result = tree_.call("rung_power", {base, exponent});
    return kind == TypeKind::Real ? tree_.cast("float", result) : result;
  }
  if (types_.isSigned(kind)) base = tree_.cast("int64_t", base);
  const Ex is_negative =
      types_.isSigned(kindOf(b)) ? tree_.infix(Operator::Less, exponent, tree_.number(0)) : tree_.fixed("false");
  return tree_.cast(
      scalarType(types_, e.type),
      tree_.call("rung_integer_power", {tree_.cast("uint64_t", base), tree_.cast("uint64_t", exponent), is_negative}));
}

}  // namespace rung::codegen
