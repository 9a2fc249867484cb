// SPDX-License-Identifier: Apache-2.0
// Values of the translated code: see translate.h. An expression has no effect, so its operands may stay in memory until
// the instruction that reads them.
#include <limits>

#include "ir/builder.h"
#include "ir/interpreter/translate.h"
#include "ir/walk.h"
#include "rung/code.h"

namespace rung::ir::interpreter {

using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

bool commutes(Op op) { return op == Op::Add || op == Op::Mul || op == Op::And || op == Op::Or || op == Op::Xor; }
Op mirrored(Op op) {
  if (op == Op::Lt) return Op::Gt;
  if (op == Op::Le) return Op::Ge;
  if (op == Op::Gt) return Op::Lt;
  if (op == Op::Ge) return Op::Le;
  return op;
}

// Memory that may not exist where nothing is checked.
bool touchesForeignMemory(const Module& module, const Body& body, ExprId root) {
  bool found = false;
  forEachExpr(body, root, [&](ExprId at) {
    const Expr& e = body.expr(at);
    found = found || e.kind == ExprKind::Deref || e.kind == ExprKind::Index || isReference(module, body, e);
  });
  return found;
}

}  // namespace

// ---- operands

Operand BodyTranslator::constant(const Expr& e) const {
  if (types_.plainKind(e.type) == TypeKind::Real) {
    const auto number = static_cast<float>(rung_f64_of(bitsOf(e)));
    return {Mode::Constant, {}, static_cast<int64_t>(rung_bits_of_f32(number))};
  }
  return {Mode::Constant, {}, static_cast<int64_t>(bitsOf(e))};
}

void BodyTranslator::valueInto(ExprId id, const Operand& to) { move(scalarOf(id), value(id, &to), to); }

// `want` is where the caller would like the value; the result is where it is.
Operand BodyTranslator::value(ExprId id, const Operand* want) {
  const Expr& e = expr(id);
  if (isPlace(e.kind)) return load(id, want);
  switch (valueKind(e.kind)) {
    case ValueKind::None: return {};
    case ValueKind::Const: return constant(e);
    case ValueKind::Zero: return {};
    case ValueKind::Unary: return unary(e, want);
    case ValueKind::Binary: return binary(e, want);
    case ValueKind::Convert: return convert(id, want);
    case ValueKind::Select: return select(e, want);
    case ValueKind::Call: return callExpression(e, want);
    case ValueKind::Address: {
      const Operand to = want != nullptr && want->mode == Mode::Frame ? *want : temp();
      pointerInto(place(e.as<AddressExpr>().place), to.ref);
      return to;
    }
    case ValueKind::String:
    case ValueKind::Data: break;
  }
  return {Mode::Frame, pointerTo(place(id)), 0};
}

// The value of a place.
Operand BodyTranslator::load(ExprId id, const Operand* want) {
  const Expr& e = expr(id);
  Operand to;
  Element at;
  if (e.kind != ExprKind::Index) return read(place(id), scalarOf(id), want);
  if (loadOfTwo(id, want, to)) return to;
  if (!element(e, at)) return read(place(id), scalarOf(id), want);
  to = target(want);
  emit(loadElementHandler(scalarOf(id), at.index_type, at.base.base, at.index.mode, to.mode), to.ref, at.base.ref,
       at.index.ref, at.site, at.range);
  return to;
}

Operand BodyTranslator::operate(Op op, Scalar type, Operand left, Operand right, const Operand* want, uint32_t site) {
  if (left.mode == Mode::Constant && right.mode == Mode::Constant) left = inFrame(left, type);
  if (left.mode == Mode::Constant && commutes(op)) std::swap(left, right);
  const int64_t imm = left.mode == Mode::Constant ? left.imm : right.imm;
  const Operand to = target(want);
  emit(binaryHandler(op, type, left.mode, right.mode, to.mode), to.ref, left.ref, right.ref, site, imm);
  return to;
}

Operand BodyTranslator::unary(const Expr& e, const Operand* want) {
  const auto [operand, op] = e.as<UnaryExpr>();
  const Scalar type = scalarOf(operand);
  Operand a = inMemory(value(operand), type);
  if ((e.checks & kCheckOverflow) != 0 && type != Scalar::Bool && op != Op::Not) {
    a = inFrame(a, type);
    emit(overflowHandler(op, type), {}, a.ref, {}, site(e.loc));
  }
  if (op == Op::Abs && !isSigned(type) && !isReal(type)) return a;
  const Operand to = target(want);
  emit(unaryHandler(op, type, a.mode, to.mode), to.ref, a.ref);
  return to;
}

Operand BodyTranslator::binary(const Expr& e, const Operand* want) {
  const auto [a, b, op] = e.as<BinaryExpr>();
  if (types::isComparison(op)) return comparison(e, want);
  if (types::isShift(op)) return shift(e, want);
  if (op == Op::Power) return power(e, want);
  const Scalar type = scalarOf(a);
  const TypeKind kind = kindOf(a);
  if (type == Scalar::Bool && (op == Op::And || op == Op::Or) && !ir::mayFault(*body_, b) &&
      touchesForeignMemory(module_, *body_, b)) {
    // Nothing is checked: memory that the left operand guards is not read, as in native code.
    const Operand to = temp();
    const Label decided = newLabel();
    valueInto(a, to);
    jumpTo(emit(branchTruthHandler(to.mode, op == Op::Or), to.ref), decided);
    valueInto(b, to);
    place(decided);
    return to;
  }
  Operand left = value(a), right = value(b);
  if (kind == TypeKind::Pointer || kind == TypeKind::Reference) right = wide(right, scalarOf(b));
  uint32_t at = 0;
  const bool divides = op == Op::Div || op == Op::Mod;
  if ((e.checks & kCheckDiv) != 0 && divides) {
    at = site(e.loc);
    if (isReal(type)) {
      const Operand divisor = inMemory(right, type), zero = temp();
      const Label ok = newLabel();
      jumpTo(emit(branchHandler(Op::Eq, type, divisor.mode, Mode::Constant, false), divisor.ref), ok);
      move(Scalar::U64, {}, zero);
      emit(raiseHandler(), {RUNG_FAULT_DIV, false}, zero.ref, {}, at);
      place(ok);
    }
  }
  if ((e.checks & kCheckOverflow) != 0 && overflowHandler(op, type) != nullptr && type != Scalar::Bool) {
    left = inFrame(left, type);
    right = inFrame(right, type);
    if (divides && at != 0 && !isReal(type)) {  // the divisor first
      const Operand zero = temp();
      emit(binaryHandler(op, type, left.mode, right.mode, Mode::Frame), zero.ref, left.ref, right.ref, at);
    }
    emit(overflowHandler(op, type), {}, left.ref, right.ref, site(e.loc));
  }
  return operate(op, type, left, right, want, isReal(type) ? 0 : at);
}

// The operands of a comparison, the left one in memory; `op` is mirrored where they change places.
std::pair<Operand, Operand> BodyTranslator::comparedValues(ExprId a, ExprId b, Op& op) {
  Operand left = value(a), right = value(b);
  if (left.mode == Mode::Constant && right.mode != Mode::Constant) {
    std::swap(left, right);
    op = mirrored(op);
  }
  return {inMemory(left, scalarOf(a)), right};
}

Operand BodyTranslator::comparison(const Expr& e, const Operand* want) {
  auto [a, b, op] = e.as<BinaryExpr>();
  const Operand to = target(want);
  if (isString(expr(a).type)) {
    const Operand order = stringOrder(a, b);
    emit(compareHandler(op, Scalar::I32, order.mode, Mode::Constant, to.mode), to.ref, order.ref);
    return to;
  }
  const Scalar type = scalarOf(a);
  const auto [left, right] = comparedValues(a, b, op);
  emit(compareHandler(op, type, left.mode, right.mode, to.mode), to.ref, left.ref, right.ref, 0, right.imm);
  return to;
}

Operand BodyTranslator::shift(const Expr& e, const Operand* want) {
  const auto [a, b, operation] = e.as<BinaryExpr>();
  const Scalar type = scalarOf(a);
  const Op op = operation == Op::Sar && !isSigned(type) ? Op::Shr : operation;
  const Operand left = inMemory(value(a), type);
  Operand count = wide(value(b), scalarOf(b));
  if (count.mode == Mode::Self) count = inFrame(count, Scalar::U64);
  const Operand to = target(want);
  emit(shiftHandler(op, type, left.mode, count.mode, to.mode), to.ref, left.ref, count.ref, 0, count.imm);
  return to;
}

Operand BodyTranslator::power(const Expr& e, const Operand* want) {
  const auto [a, b, op] = e.as<BinaryExpr>();
  const Scalar type = scalarOf(a), exponent_type = scalarOf(b);
  const Operand base = inFrame(value(a), type);
  Operand exponent = value(b);
  Scalar wide_type = isReal(type) || isReal(exponent_type) ? Scalar::F64
                     : isSigned(exponent_type)             ? Scalar::I64
                                                           : Scalar::U64;
  exponent = inFrame(wide_type == Scalar::F64 ? converted(exponent, exponent_type, Scalar::F64, nullptr)
                                              : wide(exponent, exponent_type),
                     wide_type);
  if ((e.checks & kCheckDiv) != 0 && wide_type == Scalar::I64 && !isReal(type)) {
    emit(zeroPowerHandler(type), {}, base.ref, exponent.ref, site(e.loc));
  }
  if ((e.checks & kCheckOverflow) != 0 && isReal(type)) {
    Operand other = exponent;
    if (type == Scalar::F32) other = converted(exponent, Scalar::F64, Scalar::F32, nullptr);
    emit(overflowHandler(op, type), {}, base.ref, other.ref, site(e.loc));
  }
  const Operand to = want != nullptr && want->mode == Mode::Frame ? *want : temp();
  emit(powerHandler(type, wide_type), to.ref, base.ref, exponent.ref);
  return to;
}

Operand BodyTranslator::select(const Expr& e, const Operand* want) {
  const auto [condition, yes, no] = e.as<SelectExpr>();
  const Scalar type = scalarOf(e.type);
  if (ir::mayFault(*body_, yes) || ir::mayFault(*body_, no)) {  // both are evaluated
    const Operand chooses = inFrame(value(condition), Scalar::Bool);
    const Operand a = inFrame(value(yes), type), b = inFrame(value(no), type), to = temp();
    emit(selectHandler(type), to.ref, a.ref, b.ref);
    // The condition is the fourth operand, always in the own frame.
    code_.insns.back().d = chooses.ref.offset;
    return to;
  }
  const Operand to = target(want);
  const Label otherwise = newLabel(), end = newLabel();
  branch(condition, false, otherwise);
  valueInto(yes, to);
  jump(end);
  place(otherwise);
  valueInto(no, to);
  place(end);
  return to;
}

// ---- conditions

void BodyTranslator::branch(ExprId id, bool sense, Label to) {
  const Expr& e = expr(id);
  if (e.kind == ExprKind::Const) {
    if ((bitsOf(e) != 0) == sense) jump(to);
    return;
  }
  if (isNot(e)) return branch(e.as<UnaryExpr>().operand, !sense, to);
  if (e.kind == ExprKind::Binary && types_.plainKind(e.type) == TypeKind::Bool) {
    auto [a, b, op] = e.as<BinaryExpr>();
    const bool is_and = op == Op::And;
    if ((is_and || op == Op::Or) && !ir::mayFault(*body_, b)) {
      if (is_and == sense) {  // both must agree
        const Label out = newLabel();
        branch(a, !sense, out);
        branch(b, sense, to);
        place(out);
      } else {
        branch(a, sense, to);
        branch(b, sense, to);
      }
      return;
    }
    if (types::isComparison(op)) {
      if (isString(expr(a).type)) {
        const Operand order = stringOrder(a, b);
        jumpTo(emit(branchHandler(op, Scalar::I32, order.mode, Mode::Constant, sense), order.ref), to);
        return;
      }
      const Scalar type = scalarOf(a);
      const auto [left, right] = comparedValues(a, b, op);
      jumpTo(emit(branchHandler(op, type, left.mode, right.mode, sense), left.ref, right.ref, {}, 0, right.imm), to);
      return;
    }
  }
  const Operand truth = inMemory(value(id), Scalar::Bool);
  jumpTo(emit(branchTruthHandler(truth.mode, sense), truth.ref), to);
}

// ---- conversions

Operand BodyTranslator::converted(Operand from, Scalar source, Scalar target_type, const Operand* want) {
  if (source == target_type) return from;
  if (from.mode == Mode::Constant) from = inFrame(from, source);
  const Handler handler = convertHandler(source, target_type, from.mode, want != nullptr ? want->mode : Mode::Frame);
  if (handler == nullptr) return from;  // the low bytes are the value
  const Operand to = target(want);
  emit(handler, to.ref, from.ref);
  return to;
}

Operand BodyTranslator::wide(const Operand& from, Scalar type) {
  if (from.mode == Mode::Constant) return from;  // constants are extended
  return converted(from, type, isSigned(type) ? Scalar::I64 : Scalar::U64, nullptr);
}

Operand BodyTranslator::wideBits(ExprId id) {
  const Scalar type = scalarOf(id);
  const Operand from = value(id);
  if (isReal(type)) return inFrame(converted(from, type, Scalar::F64, nullptr), Scalar::F64);
  return inFrame(wide(from, type), Scalar::U64);
}

// A REAL rounded away from zero, as I64: its last bits, or the nearest number.
Operand BodyTranslator::whole(const Operand& from, Scalar type, bool saturates) {
  const Operand real = inFrame(converted(from, type, Scalar::F64, nullptr), Scalar::F64);
  const Operand to = temp();
  emit(wholeHandler(saturates), to.ref, real.ref);
  return to;
}

// With checks, the value must fit the target (convert) or its subrange before it is cut.
void BodyTranslator::convertChecks(const Expr& e, const Operand& from) {
  const ExprId a = e.as<ConvertExpr>().operand;
  const TypeKind source = kindOf(a), target_kind = types_.plainKind(e.type);
  if (TypeTable::isString(source) || TypeTable::isString(target_kind)) return;
  const Scalar type = scalarOf(a);
  const TypeInfo& to = info(e.type);
  const uint32_t width = TypeTable::bitWidth(target_kind);
  const auto limits = [&](int64_t low, int64_t high) {
    emit(haltHandler(), {}, {}, {}, 0, low);
    emit(haltHandler(), {}, {}, {}, 0, high);
  };
  if ((e.checks & kCheckConvert) != 0 && width > 1 && !TypeTable::isReal(target_kind)) {
    const bool is_signed = types_.isSigned(target_kind);
    if (isReal(type)) {
      const Operand number = inFrame(converted(from, type, Scalar::F64, nullptr), Scalar::F64);
      const double low = is_signed ? -static_cast<double>(uint64_t{1} << (width - 1)) : 0.0;
      const double high = static_cast<double>(is_signed     ? (uint64_t{1} << (width - 1)) - 1
                                              : width == 64 ? ~uint64_t{0}
                                                            : (uint64_t{1} << width) - 1);
      emit(roundedRangeHandler(e.as<ConvertExpr>().rounding), {}, number.ref, {}, site(e.loc));
      limits(static_cast<int64_t>(rung_bits_of_f64(low)), static_cast<int64_t>(rung_bits_of_f64(high)));
    } else {
      const bool from_signed = isSigned(type);
      const Operand number = inFrame(wide(from, type), Scalar::U64);
      const int64_t low = is_signed && from_signed ? static_cast<int64_t>(~uint64_t{0} << (width - 1)) : 0;
      uint64_t high = is_signed     ? (uint64_t{1} << (width - 1)) - 1
                      : width == 64 ? ~uint64_t{0}
                                    : (uint64_t{1} << width) - 1;
      if (from_signed && high > INT64_MAX) high = INT64_MAX;
      emit(rangeHandler(RUNG_FAULT_CONVERT, from_signed), {}, number.ref, {}, site(e.loc));
      limits(low, static_cast<int64_t>(high));
    }
  }
  if ((e.checks & kCheckSubrange) != 0 && to.kind == TypeKind::Subrange) {
    const bool from_signed = isReal(type) || isSigned(type);
    const bool is_away = e.as<ConvertExpr>().rounding == types::Rounding::AwayFromZero;
    const Operand number = is_away        ? whole(from, type, true)
                           : isReal(type) ? inFrame(converted(from, type, Scalar::I64, nullptr), Scalar::I64)
                                          : inFrame(wide(from, type), Scalar::U64);
    const int64_t low = from_signed ? to.low : to.low > 0 ? to.low : 0;
    emit(rangeHandler(RUNG_FAULT_SUBRANGE, from_signed), {}, number.ref, {}, site(e.loc, to.low, to.high));
    limits(low, to.high);
  }
}

Operand BodyTranslator::convert(ExprId id, const Operand* want) {
  const Expr& e = expr(id);
  const ExprId a = e.as<ConvertExpr>().operand;
  const TypeKind source = kindOf(a), target_kind = types_.plainKind(e.type);
  const Scalar to = scalarOf(e.type);
  const TypeInfo& to_info = info(e.type);
  const bool clamps = to_info.kind == TypeKind::Subrange && types_.resolve(expr(a).type) != types_.resolve(e.type);

  Operand result;
  if (TypeTable::isString(source)) {
    const Ref pointer = pointerTo(string(a));
    const Operand bits = temp();
    emit(scalarOfStringHandler(source == TypeKind::WString), bits.ref, pointer, {},
         static_cast<uint32_t>(hostKind(types_, e.type)));
    result = to == Scalar::F32 ? converted(bits, Scalar::F64, Scalar::F32, nullptr) : bits;
  } else {
    const Scalar from = scalarOf(a);
    Operand number = value(a);
    if (e.checks != 0) convertChecks(e, number);
    if (types::changesUnit(source, target_kind)) {
      const Scalar wide_type = isSigned(from) ? Scalar::I64 : Scalar::U64;
      const int64_t unit = types::nanoseconds(source), to_unit = types::nanoseconds(target_kind);
      const int64_t day = 86'400'000'000'000 / unit;
      const auto apply = [&](Op op, int64_t by) {
        number = operate(op, wide_type, number, {Mode::Constant, {}, by}, nullptr);
      };
      number = inMemory(wide(number, from), wide_type);
      if (TypeTable::isDateTime(source) && TypeTable::isTimeOfDay(target_kind)) {
        apply(Op::Mod, day);
      } else if (TypeTable::isDateTime(source) && TypeTable::isDay(target_kind)) {
        apply(Op::Div, day);
        apply(Op::Mul, day);
      }
      if (unit > to_unit) apply(Op::Mul, unit / to_unit);
      if (to_unit > unit) apply(Op::Div, to_unit / unit);
      result = number;
    } else if (e.as<ConvertExpr>().rounding == types::Rounding::AwayFromZero) {
      result = converted(whole(number, from, false), Scalar::I64, to, clamps ? nullptr : want);
    } else {
      result = converted(number, from, to, clamps ? nullptr : want);
    }
  }
  if (!clamps) return result;
  const Operand wide_result = inMemory(wide(result, to), to);
  const Scalar wide_type = isSigned(to) ? Scalar::I64 : Scalar::U64;
  const Operand raised = operate(Op::Max, wide_type, wide_result, {Mode::Constant, {}, to_info.low}, nullptr);
  return operate(Op::Min, wide_type, raised, {Mode::Constant, {}, to_info.high}, nullptr);
}

}  // namespace rung::ir::interpreter
