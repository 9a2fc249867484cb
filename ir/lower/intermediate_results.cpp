// SPDX-License-Identifier: Apache-2.0
// Lowering of intermediate results that may be wider than their type says (sema/intermediate.h). In: checked operations
// on narrow integers. Out: operations in the native type, or, where only the last bits are wanted, in the type that
// wants them: `i := i + 1` adds in INT. Called by values.cpp and by all who see a value uncut.
#include "ir/lower/lowering.h"
#include "sema/declarations/constants.h"
#include "sema/intermediate.h"

namespace rung::ir {

ExprId ValueLowering::lowerUncut(rung::ExprId id) { return lowerOperand(id, sema::uncutType(project_, id)); }

// A conversion of an intermediate result: to at most its own width, where it is cut first, or of the uncut value.
ExprId ValueLowering::convertUncut(const rung::ConvertExpr& node) {
  const TypeId to = strip(sema::meaning(node.h).type), own = strip(sema::typeOf(tree_, node.operand));
  const TypeKind kind = types_.kind(to);
  const uint32_t width = TypeTable::isInteger(kind) || TypeTable::isBits(kind) ? TypeTable::bitWidth(kind) : 0;
  // A conversion cuts on purpose: what it cuts does not count as overflow.
  if (width == 0 || width > project_.native_width || checksOverflow())
    return convertValue(lowerUncut(node.operand), to, node.h.loc);
  const bool narrows = width <= TypeTable::bitWidth(types_.plainKind(own));
  return narrows ? convertValue(lowerValue(node.operand), to, node.h.loc) : lowerIn(node.operand, to);
}

ExprId ValueLowering::lowerIn(rung::ExprId id, TypeId type) {
  const TypeId native = sema::uncutType(project_, id);
  const Loc loc = tree_.loc(id);
  if (!native) return convertValue(lowerValue(id), type, loc);
  if (tree_.kind(id) == rung::ExprKind::Convert) return lowerIn(tree_.as<rung::ConvertExpr>(id).operand, type);
  const bool last_bits =
      sema::isRingOperation(project_, id) || (type == strip(sema::typeOf(tree_, id)) && !hasUncut(id));
  return last_bits ? operate(id, type) : convertValue(operate(id, native), type, loc);
}

// Tells whether an operand is an intermediate result itself.
bool ValueLowering::hasUncut(rung::ExprId id) const {
  if (tree_.kind(id) == rung::ExprKind::Unary)
    return static_cast<bool>(sema::uncutType(project_, tree_.as<rung::UnaryExpr>(id).operand));
  if (tree_.kind(id) == rung::ExprKind::Binary) {
    const rung::BinaryExpr& node = tree_.as<rung::BinaryExpr>(id);
    return static_cast<bool>(sema::comparedType(project_, node.left, node.right));
  }
  for (const sema::Binding& binding : project_.call(sema::meaning(tree_, id).call).bindings)
    if (binding.value && sema::uncutType(project_, binding.value)) return true;
  return false;
}

// The operation in a type: its operands, too, in that type.
ExprId ValueLowering::operate(rung::ExprId id, TypeId type) {
  const Loc loc = tree_.expr(id).loc;
  if (tree_.kind(id) == rung::ExprKind::Unary) {
    const rung::UnaryExpr& node = tree_.as<rung::UnaryExpr>(id);
    if (const auto value = sema::uncutConstant(project_, id)) return convertValue(ofValue(*value, loc), type, loc);
    const ExprId operand = lowerIn(node.operand, type);
    return node.op() == UnaryOp::Plus ? operand : arithmetic(unary(Op::Neg, type, operand, loc));
  }
  if (tree_.kind(id) == rung::ExprKind::Binary) {
    const rung::BinaryExpr& node = tree_.as<rung::BinaryExpr>(id);
    ExprId left = lowerIn(node.left, type);
    const ExprId right = lowerAfter({&left}, [&] { return lowerIn(node.right, type); });
    return arithmetic(binary(sema::operatorOf(node.op()), type, left, right, loc));
  }
  const rung::CallExpr& node = tree_.as<rung::CallExpr>(id);
  return calls().lowerArithmeticOperator(project_.call(sema::meaning(node.h).call), node, type);
}

}  // namespace rung::ir
