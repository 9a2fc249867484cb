// SPDX-License-Identifier: Apache-2.0
// Contacts in C++: conditions over bits of the process image, which are evaluated without jumps and without cutting
// each bit from its byte. In: a BOOL expression. Out: an integer that has its value at one bit. Called by
// expressions.cpp, and by image.cpp for coils.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::TypeTable;

// A constant or a variable that is where the code says, without a check; an integer may be converted to another.
bool ExpressionWriter::isPlainRead(ExprId id) const {
  if (ir::mayFault(*body_, id)) return false;
  const auto* convert = expr(id).tryAs<ir::ConvertExpr>();
  const auto isCounted = [&](ExprId of) { return TypeTable::isInteger(kindOf(of)) || TypeTable::isBits(kindOf(of)); };
  if (convert != nullptr && isCounted(id) && isCounted(convert->operand)) id = convert->operand;
  while (const auto* field = expr(id).tryAs<ir::FieldExpr>()) id = field->base;
  const ExprKind root = expr(id).kind;
  return root == ExprKind::Const || root == ExprKind::Local || root == ExprKind::Self || root == ExprKind::Image;
}

// Tells whether to evaluate all of a condition costs less than to jump around its operands: a ladder has a contact
// every few bytes of code. The operands only read and compare; in a long condition the jumps pay.
bool ExpressionWriter::isContacts(ExprId id) const {
  uint32_t steps = 0;
  bool any_bit = false;
  return readsWithoutJumps(id, steps, any_bit) && any_bit;
}

bool ExpressionWriter::readsWithoutJumps(ExprId id, uint32_t& steps, bool& any_bit) const {
  constexpr uint32_t kLongest = 40;
  const Expr& e = expr(id);
  if (++steps > kLongest) return false;
  if (ir::isNot(e)) return readsWithoutJumps(e.as<ir::UnaryExpr>().operand, steps, any_bit);
  const auto* node = e.tryAs<ir::BinaryExpr>();
  if (node == nullptr) {
    any_bit = any_bit || ir::isImageBit(e);
    return isPlainRead(id);
  }
  if (node->op == Op::And || node->op == Op::Or)
    return readsWithoutJumps(node->left, steps, any_bit) && readsWithoutJumps(node->right, steps, any_bit);
  const TypeKind kind = kindOf(node->left);
  return types::isComparison(node->op) && !TypeTable::isReal(kind) && !TypeTable::isString(kind) &&
         isPlainRead(node->left) && isPlainRead(node->right);
}

// Contacts as an integer whose bit at `position` is their value; the others are anything unless isSingleBit. A bit of
// the image is shifted once, and not cut from its byte.
cxx::Ex ExpressionWriter::bits(ExprId id, uint32_t position) {
  const Expr& e = expr(id);
  if (ir::isImageBit(e)) {
    const ir::ImageExpr& image = e.as<ir::ImageExpr>();
    const Ex byte = places().imageByte(image);
    return image.bit == position ? byte : tree_.group(shifted(byte, image.bit, position));
  }
  const auto* node = e.tryAs<ir::BinaryExpr>();
  if (node != nullptr && (node->op == Op::And || node->op == Op::Or)) {
    const Ex left = bits(node->left, position), right = bits(node->right, position);
    return tree_.infix(node->op == Op::And ? Operator::BitAnd : Operator::BitOr, left, right);
  }
  if (ir::isNot(e) && !isSingleBit(id)) return tree_.prefix("~", bits(e.as<ir::UnaryExpr>().operand, position));
  const Ex truth = value(id);
  if (position == 0) return truth;
  return tree_.group(
      tree_.infix(Operator::ShiftLeft, ir::isNot(e) ? tree_.group(truth) : truth, tree_.number(position)));
}

// The bit at `from` moved to `to`.
cxx::Ex ExpressionWriter::shifted(Ex bits, uint32_t from, uint32_t to) {
  return from > to ? tree_.infix(Operator::ShiftRight, bits, tree_.number(from - to))
                   : tree_.infix(Operator::ShiftLeft, bits, tree_.number(to - from));
}

// Tells whether `bits` has no bit but that at its position.
bool ExpressionWriter::isSingleBit(ExprId id) const {
  const Expr& e = expr(id);
  if (ir::isNot(e)) {  // ~ of contacts, ! of anything else
    const Expr& operand = expr(e.as<ir::UnaryExpr>().operand);
    return !ir::isImageBit(operand) && !ir::isNot(operand) &&
           (operand.kind != ExprKind::Binary || types::isComparison(operand.op()));
  }
  const auto* node = e.tryAs<ir::BinaryExpr>();
  if (node != nullptr && node->op == Op::And) return isSingleBit(node->left) || isSingleBit(node->right);
  if (node != nullptr && node->op == Op::Or) return isSingleBit(node->left) && isSingleBit(node->right);
  return !ir::isImageBit(e);
}

// Where g++ has the shortest code. Bits of the image: the highest, since it shifts left in fewer instructions. With
// anything else: 0, since it makes a jump of a truth value that is shifted.
uint32_t ExpressionWriter::positionOf(ExprId contacts) const {
  uint32_t highest = 0;
  return isOnlyBits(contacts, highest) ? highest : 0;
}

bool ExpressionWriter::isOnlyBits(ExprId id, uint32_t& highest) const {
  const Expr& e = expr(id);
  if (ir::isNot(e)) return isOnlyBits(e.as<ir::UnaryExpr>().operand, highest);
  if (const auto* node = e.tryAs<ir::BinaryExpr>())
    return (node->op == Op::And || node->op == Op::Or) && isOnlyBits(node->left, highest) &&
           isOnlyBits(node->right, highest);
  if (!ir::isImageBit(e)) return false;
  highest = std::max(highest, e.as<ir::ImageExpr>().bit);
  return true;
}

// Contacts as an integer that has their value at `position` and is 0 elsewhere.
cxx::Ex ExpressionWriter::bitAt(ExprId contacts, uint32_t position) {
  const uint32_t own = positionOf(contacts);
  Ex result = bits(contacts, own);
  if (!isSingleBit(contacts)) result = tree_.infix(Operator::BitAnd, result, tree_.number(1u << own));
  return own == position ? result : shifted(result, own, position);
}

}  // namespace rung::codegen
