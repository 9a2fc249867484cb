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
      switch (e.kind) {
        case ExprKind::Unary: unary(e); break;
        case ExprKind::Binary: binary(e); break;
        case ExprKind::Convert: convert(e); break;
        case ExprKind::Select: select(e); break;
        case ExprKind::Index: index(e); break;
        case ExprKind::None:
        case ExprKind::Const:
        case ExprKind::String:
        case ExprKind::Data:
        case ExprKind::Zero:
        case ExprKind::Local:
        case ExprKind::Self:
        case ExprKind::Global:
        case ExprKind::Program:
        case ExprKind::Image:
        case ExprKind::Field:
        case ExprKind::Deref:
        case ExprKind::Bits:
        case ExprKind::Call:
        case ExprKind::Address: break;
      }
    }
    return changed_;
  }

 private:
  const Expr& at(uint32_t id) const { return body_.exprs[id]; }

  void becomeOperand(Expr& e, uint32_t operand) {
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
  bool isScalarConst(const Expr& e) const { return isConst(e) && TypeTable::isScalar(types_.plainKind(e.type)); }

  void unary(Expr& e) {
    const Expr& a = at(e.a);
    if (isScalarConst(a)) {
      take(e, types::apply(types_, names_, e.op, valueOf(a)));
      return;
    }
    const bool is_inverse = e.op == Op::Not || (e.op == Op::Neg && e.checks == 0);
    if (is_inverse && a.kind == ExprKind::Unary && a.op == e.op && a.checks == 0) becomeOperand(e, a.a);
  }

  void binary(Expr& e) {
    const Expr& a = at(e.a);
    const Expr& b = at(e.b);
    const TypeKind kind = types_.plainKind(a.type);
    if ((isScalarConst(a) && isScalarConst(b)) ||
        (a.kind == ExprKind::String && b.kind == ExprKind::String && types::isComparison(e.op))) {
      if (take(e, types::apply(types_, names_, e.op, valueOf(a), valueOf(b)))) return;
    }
    if (isScalarConst(b) && !TypeTable::isReal(kind) && b.bits() != 0 && (e.op == Op::Div || e.op == Op::Mod))
      clear(e, kCheckDiv);
    if (!TypeTable::isScalar(kind)) return;
    if (TypeTable::isReal(kind)) {
      realIdentity(e, a, b);
    } else if (isScalarConst(b)) {
      rightIdentity(e, b.bits(), kind);
    } else if (isScalarConst(a)) {
      leftIdentity(e, a.bits(), kind);
    }
  }

  // Exact for every x, -0.0 and NaN included; x + 0.0 is not (it turns -0.0 into 0.0).
  void realIdentity(Expr& e, const Expr& a, const Expr& b) {
    const bool right = isConst(b), left = isConst(a);
    const double value = right ? valueOf(b).asReal() : left ? valueOf(a).asReal() : 0.0;
    if (value == 1.0 && right && (e.op == Op::Mul || e.op == Op::Div))
      becomeOperand(e, e.a);
    else if (value == 1.0 && left && e.op == Op::Mul)
      becomeOperand(e, e.b);
    else if (right && e.op == Op::Sub && b.bits() == 0)
      becomeOperand(e, e.a);  // x - (+0.0)
  }

  uint64_t ones(TypeKind kind) const {  // all bits set, as a Const has them
    const uint32_t width = TypeTable::bitWidth(kind);
    if (width >= 64 || types_.isSigned(kind)) return ~uint64_t{0};
    return (uint64_t{1} << width) - 1;
  }
  // The result is 0 or ones whatever the other operand is, if that cannot fault.
  void absorb(Expr& e, uint32_t other, uint64_t bits) {
    if (!mayFault(body_, ExprId{other})) becomeBits(e, bits);
  }

  void rightIdentity(Expr& e, uint64_t b, TypeKind kind) {
    switch (e.op) {
      case Op::Add:
      case Op::Sub:
      case Op::Xor:
        if (b == 0) becomeOperand(e, e.a);
        break;
      case Op::Or:
        if (b == 0)
          becomeOperand(e, e.a);
        else if (b == ones(kind))
          absorb(e, e.a, b);
        break;
      case Op::And:
        if (b == 0)
          absorb(e, e.a, 0);
        else if (b == ones(kind))
          becomeOperand(e, e.a);
        break;
      case Op::Mul:
        if (b == 1)
          becomeOperand(e, e.a);
        else if (b == 0)
          absorb(e, e.a, 0);
        break;
      case Op::Div:
        if (b == 1) becomeOperand(e, e.a);
        break;
      case Op::Mod:
        if (b == 1) absorb(e, e.a, 0);
        break;
      case Op::Shl:
      case Op::Shr:
        if (b == 0)
          becomeOperand(e, e.a);
        else if (b >= TypeTable::bitWidth(kind))
          absorb(e, e.a, 0);
        break;
      case Op::Rol:
      case Op::Ror:
        if (b % TypeTable::bitWidth(kind) == 0) becomeOperand(e, e.a);
        break;
      case Op::Eq:
      case Op::Ne:
        if (kind == TypeKind::Bool) compareBool(e, e.a, e.b, b != 0);
        break;
      case Op::Power:
      case Op::Neg:
      case Op::Not:
      case Op::Lt:
      case Op::Le:
      case Op::Gt:
      case Op::Ge:
      case Op::Min:
      case Op::Max:
      case Op::Abs: break;
    }
  }

  void leftIdentity(Expr& e, uint64_t a, TypeKind kind) {
    switch (e.op) {
      case Op::Add:
      case Op::Xor:
        if (a == 0) becomeOperand(e, e.b);
        break;
      case Op::Or:
        if (a == 0)
          becomeOperand(e, e.b);
        else if (a == ones(kind))
          absorb(e, e.b, a);
        break;
      case Op::And:
        if (a == 0)
          absorb(e, e.b, 0);
        else if (a == ones(kind))
          becomeOperand(e, e.b);
        break;
      case Op::Mul:
        if (a == 1)
          becomeOperand(e, e.b);
        else if (a == 0)
          absorb(e, e.b, 0);
        break;
      case Op::Shl:
      case Op::Shr:
      case Op::Rol:
      case Op::Ror:
        if (a == 0) absorb(e, e.b, 0);
        break;
      case Op::Eq:
      case Op::Ne:
        if (kind == TypeKind::Bool) compareBool(e, e.b, e.a, a != 0);
        break;
      case Op::Sub:
      case Op::Div:
      case Op::Mod:
      case Op::Power:
      case Op::Neg:
      case Op::Not:
      case Op::Lt:
      case Op::Le:
      case Op::Gt:
      case Op::Ge:
      case Op::Min:
      case Op::Max:
      case Op::Abs: break;
    }
  }

  // x = TRUE is x, x = FALSE is NOT x.
  void compareBool(Expr& e, uint32_t x, uint32_t constant, bool value) {
    if (value == (e.op == Op::Eq)) return becomeOperand(e, x);
    (void)constant;
    e.kind = ExprKind::Unary;
    e.op = Op::Not;
    e.a = x;
    e.b = 0;
    changed_ = true;
  }

  void convert(Expr& e) {
    const Expr& a = at(e.a);
    if (a.type == e.type) return becomeOperand(e, e.a);
    if (isScalarConst(a) && TypeTable::isScalar(types_.plainKind(e.type))) {
      take(e, types::convert(types_, valueOf(a), e.type));
      return;
    }
    if (a.kind == ExprKind::String && types_.kind(a.type) == types_.kind(e.type)) {
      // A string has at most as many characters as bytes, so one whose bytes fit is not cut.
      if (names_.string(NameId{a.a}).size() > types_.info(e.type).length) return;
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
    const Expr& condition = at(e.a);
    if (isConst(condition)) {
      const bool yes = condition.bits() != 0;
      if (!mayFault(body_, ExprId{yes ? e.c : e.b})) becomeOperand(e, yes ? e.b : e.c);
      return;
    }
    const Expr& b = at(e.b);
    const Expr& c = at(e.c);
    if (isConst(b) && isConst(c) && types_.kind(e.type) == TypeKind::Bool && b.bits() != 0 && c.bits() == 0)
      becomeOperand(e, e.a);
  }

  void index(Expr& e) {
    if ((e.checks & kCheckIndex) == 0) return;
    const TypeInfo& array = types_.info(types_.resolve(at(e.a).type));
    if (array.dimensions.size() != e.c) return;
    for (uint32_t i = 0; i < e.c; ++i) {
      const Expr& one = body_.expr(body_.operands[e.b + i]);
      if (!isScalarConst(one)) return;
      const auto value = static_cast<int64_t>(one.bits());
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
