// SPDX-License-Identifier: Apache-2.0
#include "sema/intermediate.h"

namespace rung::sema {

using types::TypeKind;
using types::TypeTable;

namespace {

bool isWhole(TypeKind kind) { return TypeTable::isInteger(kind) || TypeTable::isBits(kind); }

}  // namespace

TypeId nativeType(const Symbols& symbols, TypeId type) {
  const TypeKind kind = symbols.types.plainKind(type);
  if (!isWhole(kind) || TypeTable::bitWidth(kind) >= symbols.native_width) return {};
  const bool is_signed = TypeTable::isSignedInteger(kind);
  if (symbols.native_width == 64) return is_signed ? types::kLInt : types::kULInt;
  return is_signed ? types::kDInt : types::kUDInt;
}

TypeId uncutType(const Symbols& symbols, ExprId expr) {
  const ExprHeader& node = symbols.tree.expr(expr);
  if (node.kind == ExprKind::Convert) {
    const bool is_operand = (node.bits & kIntermediate) != 0;
    if (!is_operand || !uncutType(symbols, symbols.tree.as<ConvertExpr>(expr).operand)) return {};
    return nativeType(symbols, node.type);
  }
  const bool computes = node.kind == ExprKind::Binary || node.kind == ExprKind::Unary || node.kind == ExprKind::Call;
  return computes && (node.bits & kIntermediate) != 0 ? nativeType(symbols, node.type) : TypeId{};
}

TypeId comparedType(const Symbols& symbols, ExprId left, ExprId right) {
  const TypeId type = uncutType(symbols, left);
  return type ? type : uncutType(symbols, right);
}

void markIntermediate(const Symbols& symbols, ExprHeader& node, TypeId type, bool is_wide) {
  const bool marked = is_wide && nativeType(symbols, type);
  node.bits = static_cast<uint8_t>(marked ? node.bits | kIntermediate : node.bits & ~kIntermediate);
}

void markRounding(const Symbols& symbols, ExprHeader& node, TypeId from, bool is_wide) {
  const TypeKind source = symbols.types.plainKind(from), target = symbols.types.plainKind(node.type);
  const bool is_real = TypeTable::isReal(source) || source == TypeKind::RealLiteral;
  const bool is_whole = TypeTable::isScalar(target) && !TypeTable::isReal(target) && target != TypeKind::Bool;
  if (is_wide && is_real && is_whole) node.bits |= kAwayFromZero;
}

types::Rounding roundingOf(const ExprHeader& node) {
  return (node.bits & kAwayFromZero) != 0 ? types::Rounding::AwayFromZero : types::Rounding::ToEven;
}

bool isRingOperation(const Symbols& symbols, ExprId expr) {
  const Tree& tree = symbols.tree;
  if (tree.kind(expr) == ExprKind::Unary) return tree.as<UnaryExpr>(expr).op() != UnaryOp::Not;
  types::Op op;
  if (tree.kind(expr) == ExprKind::Binary) {
    op = operatorOf(tree.as<BinaryExpr>(expr).op());
  } else if (tree.kind(expr) == ExprKind::Call) {
    op = symbols.pou(symbols.call(tree.as<CallExpr>(expr).call).pou).pragmas.op;
  } else {
    return false;
  }
  return op == types::Op::Add || op == types::Op::Sub || op == types::Op::Mul;
}

}  // namespace rung::sema
