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
// the image is shifted once, and not cut from its byte. `within`: AND or OR, when this is an operand of it.
void ExpressionWriter::bits(ExprId id, uint32_t position, Op within) {
  const Expr& e = expr(id);
  if (ir::isImageBit(e)) {
    const ir::ImageExpr& image = e.as<ir::ImageExpr>();
    if (image.bit == position) return places().imageByte(image);
    out_ += '(';
    places().imageByte(image);
    out_ += image.bit > position ? " >> " : " << ";
    appendUnsigned(out_, image.bit > position ? image.bit - position : position - image.bit);
    out_ += ')';
    return;
  }
  const auto* node = e.tryAs<ir::BinaryExpr>();
  if (node != nullptr && (node->op == Op::And || node->op == Op::Or)) {
    if (node->op != within) out_ += '(';
    bits(node->left, position, node->op);
    out_ += node->op == Op::And ? " & " : " | ";
    bits(node->right, position, node->op);
    if (node->op != within) out_ += ')';
    return;
  }
  if (ir::isNot(e) && !isSingleBit(id)) {
    out_ += '~';
    return bits(e.as<ir::UnaryExpr>().operand, position, Op::Not);
  }
  if (position != 0) out_ += '(';
  value(id, ir::isNot(e) ? Prec::Postfix : Prec::Unary);  // g++ warns of `!a | b`
  if (position == 0) return;
  out_ += " << ";
  appendUnsigned(out_, position);
  out_ += ')';
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
void ExpressionWriter::bitAt(ExprId contacts, uint32_t position, Prec context) {
  const uint32_t own = positionOf(contacts);
  const bool is_cut = !isSingleBit(contacts), is_shifted = own != position;
  const auto* joined = expr(contacts).tryAs<ir::BinaryExpr>();
  const bool is_joined = joined != nullptr && !types::isComparison(joined->op);
  const Prec last = is_shifted ? Prec::Shift : is_cut || is_joined ? Prec::Bit : Prec::Postfix;
  parenthesis(last, context);
  if (is_cut && is_shifted) out_ += '(';
  bits(contacts, own, is_cut ? Op::And : is_shifted || !is_joined ? Op::Not : joined->op);
  if (is_cut) out_ += " & " + std::to_string(1u << own);
  if (is_cut && is_shifted) out_ += ')';
  if (is_shifted) {
    out_ += own > position ? " >> " : " << ";
    appendUnsigned(out_, own > position ? own - position : position - own);
  }
  closeParenthesis(last, context);
}

}  // namespace rung::codegen
