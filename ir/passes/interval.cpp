// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic: see interval.h.
#include "ir/passes/interval.h"

#include <algorithm>

namespace rung::ir {

using types::Op;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

bool hasInterval(const TypeTable& types, TypeId type) {
  const TypeKind kind = types.plainKind(type);
  return kind == TypeKind::Bool || TypeTable::isInteger(kind) || TypeTable::isBits(kind);
}

Interval intervalOf(const TypeTable& types, TypeId type, bool with_bounds) {
  const Int128 wide = Int128{1} << 100;
  if (!hasInterval(types, type)) return {-wide, wide};
  const TypeKind kind = types.plainKind(type);
  const bool is_signed = types.isSigned(kind);
  const TypeInfo& info = types.info(types.resolve(type));
  if (with_bounds && info.kind == TypeKind::Subrange) {
    if (is_signed) return {info.low, info.high};
    return {static_cast<uint64_t>(info.low), static_cast<uint64_t>(info.high)};
  }
  const uint32_t width = TypeTable::bitWidth(kind);
  if (is_signed) return {-(Int128{1} << (width - 1)), (Int128{1} << (width - 1)) - 1};
  return {0, (Int128{1} << width) - 1};
}

namespace {

// The smallest 2^n - 1 that is at least a value that is not negative.
Int128 onesAbove(Int128 value) {
  Int128 ones = 0;
  while (ones < value) ones = ones * 2 + 1;
  return ones;
}

bool isSmall(const Interval& a) {
  const Int128 limit = Int128{1} << 64;
  return a.low >= -limit && a.high <= limit;
}

// The result of an operation on values between bounds, in `type`.
struct Operation {
  const Interval &a, &b, &type;

  IntervalResult anything() const { return {type, false}; }
  IntervalResult exact(Interval r) const { return r.within(type) ? IntervalResult{r, true} : anything(); }
  IntervalResult atMost(Interval r) const { return {meet(r, type), true}; }
  bool isNotNegative() const { return a.low >= 0 && b.low >= 0; }

  IntervalResult product() const {
    if (std::max(a.high, -a.low) > (Int128{1} << 62) || std::max(b.high, -b.low) > (Int128{1} << 62)) return anything();
    const Int128 p[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    return exact({*std::min_element(p, p + 4), *std::max_element(p, p + 4)});
  }

  // Towards 0: the largest magnitude comes from the smallest divisor.
  IntervalResult quotient() const {
    if (b.low <= 0) return anything();
    const Int128 q[] = {a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high};
    return exact({*std::min_element(q, q + 4), *std::max_element(q, q + 4)});
  }

  // |result| < |divisor|, with the sign of the dividend; MOD by an unchecked 0 gives 0.
  IntervalResult remainder() const {
    const Int128 most = std::max(b.high, -b.low) - 1;
    const Int128 up = a.high > 0 ? std::min(a.high, std::max<Int128>(most, 0)) : 0;
    const Int128 down = a.low < 0 ? -std::min(-a.low, std::max<Int128>(most, 0)) : 0;
    return atMost({down, up});
  }

  IntervalResult magnitude() const {
    if (a.low >= 0) return exact(a);
    if (a.high <= 0) return exact({-a.high, -a.low});
    return exact({0, std::max(-a.low, a.high)});
  }

  IntervalResult bitwise(Op op) const {
    if (op == Op::Not) {
      const Int128 ones = type.low == 0 ? type.high : Int128{-1};
      return atMost({ones - a.high, ones - a.low});
    }
    if (op == Op::And && !isNotNegative()) {
      if (a.low >= 0) return atMost({0, a.high});
      return b.low >= 0 ? atMost({0, b.high}) : anything();
    }
    if (!isNotNegative()) return anything();
    if (op == Op::And) return atMost({0, std::min(a.high, b.high)});
    return atMost({op == Op::Or ? std::max(a.low, b.low) : Int128{0}, onesAbove(std::max(a.high, b.high))});
  }

  IntervalResult shifted(Op op) const {
    const bool is_known = isNotNegative() && b.low == b.high;
    if (op == Op::Sar) {
      const auto count = [](Int128 n) { return static_cast<int>(n < 0 || n > 127 ? 127 : n); };
      const int least = b.low < 0 ? 0 : count(b.low), most = b.low < 0 ? 127 : count(b.high);
      return atMost({std::min(a.low >> least, a.low >> most), std::max(a.high >> least, a.high >> most)});
    }
    if (op == Op::Shr) {
      if (is_known && b.low < 64) return atMost({a.low >> b.low, a.high >> b.low});
      return isNotNegative() ? atMost({0, a.high}) : anything();
    }
    if (!is_known || b.low >= 32 || a.high >= (Int128{1} << 64)) return anything();
    return exact({a.low << b.low, a.high << b.low});
  }
};

}  // namespace

IntervalResult apply(Op op, const Interval& a, const Interval& b, const Interval& type) {
  if (!isSmall(a) || !isSmall(b) || a.isEmpty() || b.isEmpty()) return {type, false};
  const Operation operation{a, b, type};
  switch (op) {
    case Op::Add: return operation.exact({a.low + b.low, a.high + b.high});
    case Op::Sub: return operation.exact({a.low - b.high, a.high - b.low});
    case Op::Mul: return operation.product();
    case Op::Div: return operation.quotient();
    case Op::Mod: return operation.remainder();
    case Op::Neg: return operation.exact({-a.high, -a.low});
    case Op::Abs: return operation.magnitude();
    case Op::And:
    case Op::Or:
    case Op::Xor:
    case Op::Not: return operation.bitwise(op);
    case Op::Shr:
    case Op::Sar:
    case Op::Shl: return operation.shifted(op);
    case Op::Eq:
    case Op::Ne:
    case Op::Lt:
    case Op::Le:
    case Op::Gt:
    case Op::Ge: return {{0, 1}, true};
    case Op::Min: return operation.atMost({std::min(a.low, b.low), std::min(a.high, b.high)});
    case Op::Max: return operation.atMost({std::max(a.low, b.low), std::max(a.high, b.high)});
    case Op::Power:
    case Op::Rol:
    case Op::Ror: return operation.anything();
  }
  return operation.anything();
}

}  // namespace rung::ir
