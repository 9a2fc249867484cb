// SPDX-License-Identifier: Apache-2.0
#include "sema/intermediate.h"

namespace rung::sema {

using types::TypeKind;
using types::TypeTable;

namespace {

bool isWholeNumber(TypeKind kind) { return TypeTable::isInteger(kind) || TypeTable::isBits(kind); }

}  // namespace

TypeId nativeType(const Symbols& symbols, TypeId type) {
  const TypeKind kind = symbols.types.plainKind(type);
  if (!isWholeNumber(kind) || TypeTable::bitWidth(kind) >= symbols.native_width) return {};
  const bool is_signed = TypeTable::isSignedInteger(kind);
  if (symbols.native_width == 64) return is_signed ? types::kLInt : types::kULInt;
  return is_signed ? types::kDInt : types::kUDInt;
}

TypeId uncutType(const Symbols& symbols, ExprId expr) {
  const Meaning& known = meaning(symbols.tree, expr);
  if (!known.is_intermediate) return {};
  if (symbols.tree.kind(expr) == ExprKind::Convert && !uncutType(symbols, symbols.tree.as<ConvertExpr>(expr).operand))
    return {};
  return nativeType(symbols, known.type);
}

TypeId comparedType(const Symbols& symbols, ExprId left, ExprId right) {
  const TypeId type = uncutType(symbols, left);
  return type ? type : uncutType(symbols, right);
}

void markIntermediate(const Symbols& symbols, ExprId expr, TypeId type, bool is_wide) {
  meaning(symbols.tree, expr).is_intermediate = is_wide && nativeType(symbols, type);
}

void markRounding(const Symbols& symbols, ExprId expr, TypeId from, bool is_wide) {
  Meaning& known = meaning(symbols.tree, expr);
  const TypeKind source = symbols.types.plainKind(from), target = symbols.types.plainKind(known.type);
  const bool is_real = TypeTable::isReal(source) || source == TypeKind::RealLiteral;
  const bool is_whole = TypeTable::isScalar(target) && !TypeTable::isReal(target) && target != TypeKind::Bool;
  if (is_wide && is_real && is_whole) known.rounds_from_zero = true;
}

types::Rounding roundingOf(const Meaning& known) {
  return known.rounds_from_zero ? types::Rounding::AwayFromZero : types::Rounding::ToEven;
}

bool isRingOperation(const Symbols& symbols, ExprId expr) {
  const Tree& tree = symbols.tree;
  if (tree.kind(expr) == ExprKind::Unary) return tree.as<UnaryExpr>(expr).op() != UnaryOp::Not;
  types::Op op;
  if (tree.kind(expr) == ExprKind::Binary) {
    op = operatorOf(tree.as<BinaryExpr>(expr).op());
  } else if (tree.kind(expr) == ExprKind::Call) {
    op = symbols.pou(symbols.call(meaning(tree, expr).call).pou).pragmas.op;
  } else {
    return false;
  }
  return op == types::Op::Add || op == types::Op::Sub || op == types::Op::Mul;
}

}  // namespace rung::sema
