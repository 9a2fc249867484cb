// SPDX-License-Identifier: Apache-2.0
// The arithmetic kernel (see arithmetic.h). Compiled with -ffp-contract=off: a REAL result is rounded after each
// operation, as in generated code.
#include "sema/types/arithmetic.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "frontend/source/invariant.h"
#include "frontend/source/text.h"

namespace rung::types {

namespace {

using Int128 = __int128;

struct OpRow {
  const char* word;
  int operands;
};
constexpr OpRow kOps[] = {
#define RUNG_OPERATOR(name, word, operands) {word, operands},
#include "sema/types/operators.def"
};

// The value that `bits` has after a store to a variable of this kind: cut to its width, then extended.
uint64_t wrap(const TypeTable& table, TypeKind kind, uint64_t bits) {
  const uint32_t width = TypeTable::bitWidth(kind);
  if (width == 0 || width >= 64) return bits;
  const uint64_t mask = (uint64_t{1} << width) - 1;
  bits &= mask;
  if (table.isSigned(kind) && (bits >> (width - 1)) != 0) bits |= ~mask;
  return bits;
}

Int128 exact(const TypeTable& table, TypeKind kind, uint64_t bits) {
  return table.isSigned(kind) ? Int128{static_cast<int64_t>(bits)} : Int128{bits};
}

struct Range {
  Int128 low, high;
};
Range rangeOf(const TypeTable& table, TypeKind kind) {
  const uint32_t width = TypeTable::bitWidth(kind);
  if (table.isSigned(kind)) return {-(Int128{1} << (width - 1)), (Int128{1} << (width - 1)) - 1};
  return {0, (Int128{1} << width) - 1};
}

Outcome ofExact(const TypeTable& table, TypeId type, TypeKind kind, Int128 value) {
  Outcome out;
  out.value = {type, wrap(table, kind, static_cast<uint64_t>(value))};
  out.overflow = exact(table, kind, out.value.bits) != value;
  return out;
}

Outcome ofBool(bool value) {
  Outcome out;
  out.value = {kBool, value ? 1u : 0u};
  return out;
}

Outcome compare(Op op, int order, bool unordered) {
  if (unordered) return ofBool(op == Op::Ne);
  if (op == Op::Eq) return ofBool(order == 0);
  if (op == Op::Ne) return ofBool(order != 0);
  if (op == Op::Lt) return ofBool(order < 0);
  if (op == Op::Le) return ofBool(order <= 0);
  if (op == Op::Gt) return ofBool(order > 0);
  return ofBool(order >= 0);
}

// The shorter string counts as padded with NUL.
int compareStrings(std::string_view a, std::string_view b, bool wide) {
  if (!wide) return a.compare(b);
  Utf16Units left(a), right(b);
  for (;;) {
    const uint32_t x = left.next(), y = right.next();
    if (x != y) return x < y ? -1 : 1;
    if (x == 0) return 0;
  }
}

Outcome applyString(const Names& names, Op op, const Value& left, const Value& right, bool wide) {
  const int order = compareStrings(names.string(NameId{static_cast<uint32_t>(left.bits)}),
                                   names.string(NameId{static_cast<uint32_t>(right.bits)}), wide);
  if (isComparison(op)) return compare(op, order, false);
  Outcome out;
  out.value = (op == Op::Min) == (order < 0) ? left : right;
  return out;
}

template <class Float>
Outcome applyReal(const TypeTable& table, Op op, const Value& left, const Value& right) {
  const auto a = static_cast<Float>(left.asReal());
  Float b = 0;
  if (operandCount(op) == 2) {
    const TypeKind kind = table.plainKind(right.type);
    if (op == Op::Power && !TypeTable::isReal(kind) && kind != TypeKind::RealLiteral) {
      // An integer exponent: exact in a double up to 2^53, and nothing beyond matters to pow.
      const double exponent =
          table.isSigned(kind) ? static_cast<double>(right.asSigned()) : static_cast<double>(right.bits);
      Outcome out;
      out.value = Value::ofReal(left.type, static_cast<Float>(std::pow(static_cast<double>(a), exponent)));
      out.overflow = std::isinf(out.value.asReal()) && std::isfinite(a);
      return out;
    }
    b = static_cast<Float>(right.asReal());
  }
  if (isComparison(op)) return compare(op, a < b ? -1 : (a > b ? 1 : 0), std::isnan(a) || std::isnan(b));
  Float result = 0;
  switch (op) {
    case Op::Add: result = a + b; break;
    case Op::Sub: result = a - b; break;
    case Op::Mul: result = a * b; break;
    case Op::Div: result = a / b; break;
    case Op::Mod: result = std::fmod(a, b); break;
    case Op::Power: result = static_cast<Float>(std::pow(static_cast<double>(a), right.asReal())); break;  // not cut
    case Op::Neg: result = -a; break;
    case Op::Abs: result = std::fabs(a); break;
    case Op::Min: result = b < a ? b : a; break;
    case Op::Max: result = b > a ? b : a; break;
    case Op::And:
    case Op::Or:
    case Op::Xor:
    case Op::Not:
    case Op::Shl:
    case Op::Shr:
    case Op::Sar:
    case Op::Rol:
    case Op::Ror:
    case Op::Eq:
    case Op::Ne:
    case Op::Lt:
    case Op::Le:
    case Op::Gt:
    case Op::Ge: RUNG_INVARIANT(false, "bit operators have no REAL operands");
  }
  Outcome out;
  out.value = Value::ofReal(left.type, static_cast<double>(result));
  out.overflow = std::isinf(result) && std::isfinite(a) && std::isfinite(b);
  return out;
}

// x ** n for integers by squaring, modulo 2^64; a negative exponent leaves 0, 1 or -1.
Outcome integerPower(const TypeTable& table, const Value& left, const Value& right, TypeKind kind) {
  const bool negative = table.isSigned(table.plainKind(right.type)) && right.asSigned() < 0;
  const Int128 base = exact(table, kind, left.bits);
  Outcome out;
  if (negative) {
    if (base == 0) {
      out.value = {left.type, 0};
      out.fault = Fault::Div;
      return out;
    }
    if (base == 1) return ofExact(table, left.type, kind, 1);
    if (base == -1) return ofExact(table, left.type, kind, (right.bits & 1) != 0 ? -1 : 1);
    return ofExact(table, left.type, kind, 0);
  }
  uint64_t result = 1, factor = left.bits;
  for (uint64_t n = right.bits; n != 0; n >>= 1) {
    if ((n & 1) != 0) result *= factor;
    factor *= factor;
  }
  out.value = {left.type, wrap(table, kind, result)};
  out.overflow = std::fabs(std::pow(static_cast<double>(base), static_cast<double>(right.bits))) >
                 static_cast<double>(rangeOf(table, kind).high) + 1.0;
  return out;
}

// A product of 64 bits, which Int128 may not hold.
Outcome multiplyLong(const TypeTable& table, const Value& left, const Value& right, TypeKind kind) {
  Outcome out;
  out.value = {left.type, wrap(table, kind, left.bits * right.bits)};
  if (table.isSigned(kind)) {
    int64_t ignored;
    out.overflow = __builtin_mul_overflow(left.asSigned(), right.asSigned(), &ignored);
  } else {
    uint64_t ignored;
    out.overflow = __builtin_mul_overflow(left.bits, right.bits, &ignored);
  }
  return out;
}

uint64_t rotatedLeft(uint64_t bits, uint64_t by, uint32_t width) {
  const auto n = static_cast<uint32_t>(by % width);
  return n == 0 ? bits : bits << n | bits >> (width - n);
}

Outcome applyInteger(const TypeTable& table, Op op, const Value& left, const Value& right, TypeKind kind) {
  const uint32_t width = TypeTable::bitWidth(kind);
  const uint64_t mask = width >= 64 ? ~uint64_t{0} : (uint64_t{1} << width) - 1;
  const Int128 a = exact(table, kind, left.bits), b = exact(table, kind, right.bits);
  const auto ofBits = [&](uint64_t bits) {
    Outcome out;
    out.value = {left.type, wrap(table, kind, bits)};
    return out;
  };
  switch (op) {
    case Op::Add: return ofExact(table, left.type, kind, a + b);
    case Op::Sub: return ofExact(table, left.type, kind, a - b);
    case Op::Mul: return width < 64 ? ofExact(table, left.type, kind, a * b) : multiplyLong(table, left, right, kind);
    case Op::Div:
    case Op::Mod: {
      if (b == 0) {
        Outcome out = ofBits(0);
        out.fault = Fault::Div;
        return out;
      }
      return ofExact(table, left.type, kind, op == Op::Div ? a / b : a % b);
    }
    case Op::Power: return integerPower(table, left, right, kind);
    case Op::Neg: return ofExact(table, left.type, kind, -a);
    case Op::Abs: return ofExact(table, left.type, kind, a < 0 ? -a : a);
    case Op::And: return ofBits(left.bits & right.bits);
    case Op::Or: return ofBits(left.bits | right.bits);
    case Op::Xor: return ofBits(left.bits ^ right.bits);
    case Op::Not: return ofBits(~left.bits);
    case Op::Shl: return ofBits(right.bits >= width ? 0 : left.bits << right.bits);
    case Op::Shr: return ofBits(right.bits >= width ? 0 : (left.bits & mask) >> right.bits);
    case Op::Sar: return ofBits(static_cast<uint64_t>(a >> std::min<uint64_t>(right.bits, 64)));
    case Op::Rol: return ofBits(rotatedLeft(left.bits & mask, right.bits, width));
    case Op::Ror: return ofBits(rotatedLeft(left.bits & mask, width - right.bits % width, width));
    case Op::Eq:
    case Op::Ne:
    case Op::Lt:
    case Op::Le:
    case Op::Gt:
    case Op::Ge: return compare(op, a < b ? -1 : (a > b ? 1 : 0), false);
    case Op::Min: return ofBits(a < b ? left.bits : right.bits);
    case Op::Max: return ofBits(a > b ? left.bits : right.bits);
  }
  return {};
}

// The last 64 bits of a whole number of any size.
uint64_t lastBits(double whole) {
  const double rest = std::fmod(whole, 0x1p64);  // exact; NaN for an infinite number
  return std::isnan(rest) ? 0 : static_cast<uint64_t>(static_cast<Int128>(rest));
}

Outcome realToInteger(const TypeTable& table, double value, TypeId to, TypeKind kind, Rounding rounding) {
  Outcome out;
  out.value.type = to;
  if (std::isnan(value)) {
    out.overflow = true;
    return out;
  }
  if (kind == TypeKind::Bool) {
    out.value.bits = value != 0 ? 1 : 0;
    return out;
  }
  const bool to_even = rounding == Rounding::ToEven;
  const double rounded = to_even ? std::nearbyint(value) : std::round(value);  // the rounding mode is never changed
  const Range range = rangeOf(table, kind);
  if (!to_even) {
    out.value.bits = wrap(table, kind, lastBits(rounded));
    out.overflow = rounded < static_cast<double>(range.low) || rounded >= static_cast<double>(range.high) + 1.0;
  } else if (rounded < static_cast<double>(range.low)) {
    out.value.bits = static_cast<uint64_t>(range.low);
    out.overflow = true;
  } else if (rounded >= static_cast<double>(range.high) + 1.0) {
    out.value.bits = static_cast<uint64_t>(range.high);
    out.overflow = true;
  } else {
    out.value.bits = static_cast<uint64_t>(static_cast<Int128>(rounded));
  }
  return out;
}

}  // namespace

const char* word(Op op) { return kOps[static_cast<size_t>(op)].word; }
int operandCount(Op op) { return kOps[static_cast<size_t>(op)].operands; }
bool findOp(std::string_view word, Op& op) {
  for (size_t i = 0; i < std::size(kOps); ++i) {
    if (word == kOps[i].word) {
      op = static_cast<Op>(i);
      return true;
    }
  }
  return false;
}
bool isComparison(Op op) { return op >= Op::Eq && op <= Op::Ge; }
bool isShift(Op op) { return op >= Op::Shl && op <= Op::Ror; }
bool mayOverflow(Op op) { return (op <= Op::Neg && op != Op::Mod) || op == Op::Abs; }

const char* word(Fault fault) {
  switch (fault) {
    case Fault::None: return "none";
    case Fault::Div: return "div";
    case Fault::Index: return "index";
    case Fault::Null: return "null";
    case Fault::Cast: return "cast";
    case Fault::Subrange: return "subrange";
    case Fault::Convert: return "convert";
    case Fault::Overflow: return "overflow";
    case Fault::Lock: return "lock";
    case Fault::Stack: return "stack";
    case Fault::Stop: return "stop";
  }
  return "none";
}

double Value::asReal() const {
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

Value Value::ofReal(TypeId type, double value) {
  Value result;
  result.type = type;
  std::memcpy(&result.bits, &value, sizeof value);
  return result;
}

Outcome apply(const TypeTable& table, const Names& names, Op op, const Value& left, const Value& right) {
  const TypeKind kind = table.plainKind(left.type);
  if (TypeTable::isString(kind)) return applyString(names, op, left, right, kind == TypeKind::WString);
  if (kind == TypeKind::Real) return applyReal<float>(table, op, left, right);
  if (kind == TypeKind::LReal || kind == TypeKind::RealLiteral) return applyReal<double>(table, op, left, right);
  // Untyped integers count as LINT until their context types them.
  return applyInteger(table, op, left, right, kind == TypeKind::IntegerLiteral ? TypeKind::LInt : kind);
}

int64_t nanoseconds(TypeKind kind) {
  if (kind == TypeKind::Time || kind == TypeKind::TimeOfDay) return 1'000'000;
  if (kind == TypeKind::Date || kind == TypeKind::DateTime) return 1'000'000'000;
  return 1;
}

bool changesUnit(TypeKind from, TypeKind to) {
  const bool from_span = TypeTable::isDuration(from) || TypeTable::isTimeOfDay(from);
  const bool to_span = TypeTable::isDuration(to) || TypeTable::isTimeOfDay(to);
  const bool from_date = TypeTable::isDay(from) || TypeTable::isDateTime(from);
  const bool to_date = TypeTable::isDay(to) || TypeTable::isDateTime(to);
  return from != to && ((from_span && to_span) || (from_date && to_date) ||
                        (TypeTable::isDateTime(from) && TypeTable::isTimeOfDay(to)));
}

Outcome convert(const TypeTable& table, const Value& value, TypeId to, Rounding rounding) {
  const TypeKind written_from = table.plainKind(value.type), kind = table.plainKind(to);
  const TypeKind from = written_from == TypeKind::IntegerLiteral ? TypeKind::LInt : written_from;
  Outcome out;
  const bool from_real = TypeTable::isReal(from) || from == TypeKind::RealLiteral;
  if (kind == TypeKind::Real || kind == TypeKind::LReal || kind == TypeKind::RealLiteral) {
    double number = value.asReal();
    if (kind == TypeKind::Real) {
      const float narrow = from_real              ? static_cast<float>(number)
                           : table.isSigned(from) ? static_cast<float>(value.asSigned())
                                                  : static_cast<float>(value.bits);
      out.overflow = from_real && std::isinf(narrow) && std::isfinite(number);
      number = narrow;
    } else if (!from_real) {
      number = table.isSigned(from) ? static_cast<double>(value.asSigned()) : static_cast<double>(value.bits);
    }
    out.value = Value::ofReal(to, number);
    return out;
  }
  if (!TypeTable::isScalar(kind)) {
    out.value = {to, value.bits};
    return out;
  }
  if (from_real) {
    out = realToInteger(table, value.asReal(), to, kind, rounding);
  } else if (kind == TypeKind::Bool) {
    out.value = {to, value.bits != 0 ? 1u : 0u};
    out.overflow = value.bits > 1;
  } else {
    Int128 number = exact(table, from, value.bits);
    if (changesUnit(from, kind)) {
      constexpr Int128 kDay = Int128{86'400} * 1'000'000'000;
      number *= nanoseconds(from);
      if (TypeTable::isDateTime(from) && TypeTable::isTimeOfDay(kind)) number %= kDay;
      if (TypeTable::isDateTime(from) && TypeTable::isDay(kind)) number -= number % kDay;
      number /= nanoseconds(kind);
    }
    out = ofExact(table, to, kind, number);
  }
  const TypeInfo& target = table.info(table.resolve(to));
  if (target.kind == TypeKind::Subrange) {
    const Int128 low = exact(table, kind, static_cast<uint64_t>(target.low));
    const Int128 high = exact(table, kind, static_cast<uint64_t>(target.high));
    const Int128 now = exact(table, kind, out.value.bits);
    if (now < low || now > high) {
      out.value.bits = static_cast<uint64_t>(now < low ? target.low : target.high);
      out.overflow = true;
    }
  }
  return out;
}

Value defaultValue(const TypeTable& table, Names& names, TypeId type) {
  const TypeInfo& info = table.info(table.resolve(type));
  Value value{type, 0};
  if (info.kind == TypeKind::Subrange) value.bits = static_cast<uint64_t>(info.initial);
  if (info.kind == TypeKind::Enum && !info.items.empty()) value.bits = static_cast<uint64_t>(info.items[0].second);
  if (TypeTable::isString(info.kind)) value.bits = names.intern("").index;
  return value;
}

bool isLossless(const TypeTable& table, TypeId from, TypeId to) {
  if (table.resolve(from) == table.resolve(to)) return true;
  const TypeInfo& source = table.info(table.resolve(from));
  const TypeInfo& target = table.info(table.resolve(to));
  const TypeKind a = table.plainKind(from), b = table.plainKind(to);
  if (TypeTable::isString(a)) return a == b && source.length <= target.length;
  if (!TypeTable::isScalar(a) || !TypeTable::isScalar(b)) return false;
  if (target.kind == TypeKind::Enum) return false;  // except its own items, which have its type
  const auto isNumber = [](TypeKind k) { return TypeTable::isInteger(k) || TypeTable::isBits(k); };
  if (isNumber(a) && isNumber(b)) {
    Range from_range = rangeOf(table, a), to_range = rangeOf(table, b);
    if (source.kind == TypeKind::Subrange) {
      from_range = {exact(table, a, static_cast<uint64_t>(source.low)),
                    exact(table, a, static_cast<uint64_t>(source.high))};
    }
    if (target.kind == TypeKind::Subrange) {
      to_range = {exact(table, b, static_cast<uint64_t>(target.low)),
                  exact(table, b, static_cast<uint64_t>(target.high))};
    }
    return from_range.low >= to_range.low && from_range.high <= to_range.high;
  }
  if (isNumber(a) && b == TypeKind::Real) return TypeTable::bitWidth(a) <= 16;
  if (isNumber(a) && b == TypeKind::LReal) return TypeTable::bitWidth(a) <= 32;
  if (a == TypeKind::Real) return b == TypeKind::LReal || b == TypeKind::Real;
  if (a == TypeKind::Bool) return b == TypeKind::Bool || TypeTable::isBits(b);
  if (a == TypeKind::Time && b == TypeKind::LTime) return !table.isSigned(a) || table.isSigned(b);
  return a == b || (a == TypeKind::Date && b == TypeKind::LDate) ||
         (a == TypeKind::TimeOfDay && b == TypeKind::LTimeOfDay) ||
         (a == TypeKind::DateTime && b == TypeKind::LDateTime) ||
         (TypeTable::isCharacter(a) && TypeTable::isCharacter(b) && a < b);
}

}  // namespace rung::types
