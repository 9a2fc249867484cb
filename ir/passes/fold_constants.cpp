// SPDX-License-Identifier: Apache-2.0
// Constant folding: see fold_constants.h. All arithmetic is the kernel's (sema/types/arithmetic.h).
#include "ir/passes/fold_constants.h"

#include "ir/passes/support.h"

namespace rung::ir {

using types::Outcome;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

class Folder {
 public:
  Folder(Module& module, Body& body) : types_(module.types), names_(module.names), body_(body) {}

  bool run() {
    for (uint32_t i = 1; i < body_.exprs.size(); ++i) {
      Expr& e = body_.exprs[i];
      if (e.kind == ExprKind::Index) index(e);
      if (roleOf(e.kind) != ExprRole::Value) continue;
      if (e.kind == ExprKind::Unary)
        unary(e);
      else if (e.kind == ExprKind::Binary)
        binary(e);
      else if (e.kind == ExprKind::Convert)
        convert(e);
      else if (e.kind == ExprKind::Select)
        select(e);
    }
    return changed_;
  }

 private:
  const Expr& at(ExprId id) const { return body_.expr(id); }

  void becomeOperand(Expr& e, ExprId operand) {
    if (at(operand).type != e.type) return;
    const Loc loc = e.loc;
    e = at(operand);
    e.loc = loc;
    changed_ = true;
  }
  void becomeBits(Expr& e, uint64_t bits) {
    becomeConst(e, e.type, bits);
    changed_ = true;
  }
  void clear(Expr& e, uint8_t check) {
    if ((e.checks & check) == 0) return;
    e.checks = static_cast<uint8_t>(e.checks & ~check);
    changed_ = true;
  }
  // Takes the kernel's result unless it is a fault that the node's checks report.
  bool take(Expr& e, const Outcome& outcome) {
    if (outcome.fault == types::Fault::Div && (e.checks & kCheckDiv) != 0) return false;
    if (outcome.overflow && (e.checks & (kCheckOverflow | kCheckSubrange | kCheckConvert)) != 0) return false;
    becomeBits(e, outcome.value.bits);
    return true;
  }
  static types::Value valueOf(const Expr& e) {
    const auto* string = e.tryAs<StringExpr>();
    return {e.type, string != nullptr ? string->characters.index : bitsOf(e)};
  }
  bool isScalarConst(const Expr& e) const { return isConst(e) && TypeTable::isScalar(types_.plainKind(e.type)); }

  void unary(Expr& e) {
    const auto [operand, op] = e.as<UnaryExpr>();
    const Expr& a = at(operand);
    if (isScalarConst(a)) {
      take(e, types::apply(types_, names_, op, valueOf(a)));
      return;
    }
    const bool is_inverse = op == Op::Not || (op == Op::Neg && e.checks == 0);
    const auto* inner = a.tryAs<UnaryExpr>();
    if (is_inverse && inner != nullptr && inner->op == op && a.checks == 0) becomeOperand(e, inner->operand);
  }

  void binary(Expr& e) {
    const BinaryExpr node = e.as<BinaryExpr>();
    const Expr& a = at(node.left);
    const Expr& b = at(node.right);
    const TypeKind kind = types_.plainKind(a.type);
    if ((isScalarConst(a) && isScalarConst(b)) ||
        (a.kind == ExprKind::String && b.kind == ExprKind::String && types::isComparison(node.op))) {
      if (take(e, types::apply(types_, names_, node.op, valueOf(a), valueOf(b)))) return;
    }
    const bool divides = node.op == Op::Div || node.op == Op::Mod;
    if (isScalarConst(b) && !TypeTable::isReal(kind) && bitsOf(b) != 0 && divides) clear(e, kCheckDiv);
    if (!TypeTable::isScalar(kind)) return;
    if (TypeTable::isReal(kind)) {
      realIdentity(e, node);
    } else if (isScalarConst(b)) {
      rightIdentity(e, node, bitsOf(b), kind);
    } else if (isScalarConst(a)) {
      leftIdentity(e, node, bitsOf(a), kind);
    }
  }

  // Exact for every x, -0.0 and NaN included; x + 0.0 is not (it turns -0.0 into 0.0).
  void realIdentity(Expr& e, const BinaryExpr& node) {
    const Expr& a = at(node.left);
    const Expr& b = at(node.right);
    const bool right = isConst(b), left = isConst(a);
    const double value = right ? valueOf(b).asReal() : left ? valueOf(a).asReal() : 0.0;
    if (value == 1.0 && right && (node.op == Op::Mul || node.op == Op::Div))
      becomeOperand(e, node.left);
    else if (value == 1.0 && left && node.op == Op::Mul)
      becomeOperand(e, node.right);
    else if (right && node.op == Op::Sub && bitsOf(b) == 0)
      becomeOperand(e, node.left);  // x - (+0.0)
  }

  uint64_t ones(TypeKind kind) const {  // all bits set, as a Const has them
    const uint32_t width = TypeTable::bitWidth(kind);
    if (width >= 64 || types_.isSigned(kind)) return ~uint64_t{0};
    return (uint64_t{1} << width) - 1;
  }
  // The result is 0 or ones whatever the other operand is, if that cannot fault.
  void absorb(Expr& e, ExprId other, uint64_t bits) {
    if (!mayFault(body_, other)) becomeBits(e, bits);
  }

  // Operators with which the operands may change places: `bits` is either of them, `other` the one that stays.
  void eitherIdentity(Expr& e, Op op, ExprId other, uint64_t bits, TypeKind kind) {
    const bool is_all = bits == ones(kind);
    const bool sums = op == Op::Add || op == Op::Or || op == Op::Xor;
    const bool keeps_other = (sums && bits == 0) || (op == Op::And && is_all) || (op == Op::Mul && bits == 1);
    const bool decides = (op == Op::Or && is_all) || ((op == Op::And || op == Op::Mul) && bits == 0);
    if (keeps_other)
      becomeOperand(e, other);
    else if (decides)
      absorb(e, other, bits);
    else if (kind == TypeKind::Bool && (op == Op::Eq || op == Op::Ne))
      compareBool(e, op, other, bits != 0);
  }

  void rightIdentity(Expr& e, const BinaryExpr& node, uint64_t b, TypeKind kind) {
    const uint32_t width = TypeTable::bitWidth(kind);
    const bool shifts = node.op == Op::Shl || node.op == Op::Shr;
    const bool keeps = shifts || node.op == Op::Sar || node.op == Op::Sub;
    const bool rotates = node.op == Op::Rol || node.op == Op::Ror;
    if ((b == 0 && keeps) || (b == 1 && node.op == Op::Div) || (rotates && b % width == 0))
      becomeOperand(e, node.left);
    else if ((b == 1 && node.op == Op::Mod) || (shifts && b >= width))
      absorb(e, node.left, 0);
    else
      eitherIdentity(e, node.op, node.left, b, kind);
  }

  void leftIdentity(Expr& e, const BinaryExpr& node, uint64_t a, TypeKind kind) {
    if (types::isShift(node.op) && a == 0)
      absorb(e, node.right, 0);
    else
      eitherIdentity(e, node.op, node.right, a, kind);
  }

  // x = TRUE is x, x = FALSE is NOT x.
  void compareBool(Expr& e, Op op, ExprId x, bool value) {
    if (value == (op == Op::Eq)) return becomeOperand(e, x);
    e.set(UnaryExpr{x, Op::Not});
    changed_ = true;
  }

  void convert(Expr& e) {
    const auto [operand, rounding] = e.as<ConvertExpr>();
    const Expr& a = at(operand);
    if (a.type == e.type) return becomeOperand(e, operand);
    if (isScalarConst(a) && TypeTable::isScalar(types_.plainKind(e.type))) {
      take(e, types::convert(types_, valueOf(a), e.type, rounding));
      return;
    }
    const auto* string = a.tryAs<StringExpr>();
    if (string != nullptr && types_.kind(a.type) == types_.kind(e.type)) {
      // A string has at most as many characters as bytes, so one whose bytes fit is not cut.
      if (names_.string(string->characters).size() > types_.info(e.type).length) return;
      const TypeId type = e.type;
      e = a;
      e.type = type;
      changed_ = true;
      return;
    }
    if (e.checks != 0 && types::isLossless(types_, a.type, e.type))
      clear(e, kCheckSubrange | kCheckConvert | kCheckOverflow);
  }

  void select(Expr& e) {
    const SelectExpr node = e.as<SelectExpr>();
    const Expr& condition = at(node.condition);
    if (isConst(condition)) {
      const bool yes = bitsOf(condition) != 0;
      if (!mayFault(body_, yes ? node.when_false : node.when_true))
        becomeOperand(e, yes ? node.when_true : node.when_false);
      return;
    }
    const Expr& yes = at(node.when_true);
    const Expr& no = at(node.when_false);
    if (isConst(yes) && isConst(no) && types_.kind(e.type) == TypeKind::Bool && bitsOf(yes) != 0 && bitsOf(no) == 0)
      becomeOperand(e, node.condition);
  }

  void index(Expr& e) {
    if ((e.checks & kCheckIndex) == 0) return;
    const IndexExpr& node = e.as<IndexExpr>();
    const TypeInfo& array = types_.info(types_.resolve(at(node.base).type));
    if (array.dimensions.size() != node.indices.count) return;
    for (uint32_t i = 0; i < node.indices.count; ++i) {
      const Expr& one = at(body_.list(node.indices)[i]);
      if (!isScalarConst(one)) return;
      const auto value = static_cast<int64_t>(bitsOf(one));
      if (value < 0 && !types_.isSigned(types_.plainKind(one.type))) return;
      if (value < array.dimensions[i].low || value > array.dimensions[i].high) return;
    }
    clear(e, kCheckIndex);
  }

  const TypeTable& types_;
  const Names& names_;
  Body& body_;
  bool changed_ = false;
};

}  // namespace

bool foldConstants(Module& module, Body& body) { return Folder(module, body).run(); }

}  // namespace rung::ir
