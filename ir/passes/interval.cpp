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

}  // namespace

IntervalResult apply(Op op, const Interval& a, const Interval& b, const Interval& type) {
  const auto exact = [&](Interval r) { return r.within(type) ? IntervalResult{r, true} : IntervalResult{type, false}; };
  const auto atMost = [&](Interval r) { return IntervalResult{meet(r, type), true}; };
  const IntervalResult anything{type, false};
  if (!isSmall(a) || !isSmall(b) || a.isEmpty() || b.isEmpty()) return anything;
  const bool not_negative = a.low >= 0 && b.low >= 0;
  switch (op) {
    case Op::Add: return exact({a.low + b.low, a.high + b.high});
    case Op::Sub: return exact({a.low - b.high, a.high - b.low});
    case Op::Mul: {
      if (std::max(a.high, -a.low) > (Int128{1} << 62) || std::max(b.high, -b.low) > (Int128{1} << 62)) return anything;
      const Int128 p[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
      return exact({*std::min_element(p, p + 4), *std::max_element(p, p + 4)});
    }
    case Op::Div: {
      if (b.low > 0) {  // towards 0: the largest magnitude comes from the smallest divisor
        const Int128 q[] = {a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high};
        return exact({*std::min_element(q, q + 4), *std::max_element(q, q + 4)});
      }
      return anything;
    }
    case Op::Mod: {  // |result| < |divisor|, sign of the dividend; MOD by an unchecked 0 gives 0
      const Int128 most = std::max(b.high, -b.low) - 1;
      const Int128 up = a.high > 0 ? std::min(a.high, std::max<Int128>(most, 0)) : 0;
      const Int128 down = a.low < 0 ? -std::min(-a.low, std::max<Int128>(most, 0)) : 0;
      return atMost({down, up});
    }
    case Op::Neg: return exact({-a.high, -a.low});
    case Op::Abs:
      if (a.low >= 0) return exact(a);
      if (a.high <= 0) return exact({-a.high, -a.low});
      return exact({0, std::max(-a.low, a.high)});
    case Op::And:
      if (not_negative) return atMost({0, std::min(a.high, b.high)});
      if (a.low >= 0) return atMost({0, a.high});
      if (b.low >= 0) return atMost({0, b.high});
      return anything;
    case Op::Or:
      if (not_negative) return atMost({std::max(a.low, b.low), onesAbove(std::max(a.high, b.high))});
      return anything;
    case Op::Xor:
      if (not_negative) return atMost({0, onesAbove(std::max(a.high, b.high))});
      return anything;
    case Op::Not:
      if (type.low == 0) return atMost({type.high - a.high, type.high - a.low});
      return atMost({-1 - a.high, -1 - a.low});
    case Op::Shr:
      if (not_negative && b.low == b.high && b.low < 64) return atMost({a.low >> b.low, a.high >> b.low});
      if (not_negative) return atMost({0, a.high});
      return anything;
    case Op::Sar: {
      const auto count = [](Int128 n) { return static_cast<int>(n < 0 || n > 127 ? 127 : n); };
      const int least = b.low < 0 ? 0 : count(b.low), most = b.low < 0 ? 127 : count(b.high);
      return atMost({std::min(a.low >> least, a.low >> most), std::max(a.high >> least, a.high >> most)});
    }
    case Op::Shl:
      if (not_negative && b.low == b.high && b.low < 32 && a.high < (Int128{1} << 64)) {
        const Interval r{a.low << b.low, a.high << b.low};
        return r.within(type) ? IntervalResult{r, true} : anything;
      }
      return anything;
    case Op::Eq:
    case Op::Ne:
    case Op::Lt:
    case Op::Le:
    case Op::Gt:
    case Op::Ge: return {{0, 1}, true};
    case Op::Min: return atMost({std::min(a.low, b.low), std::min(a.high, b.high)});
    case Op::Max: return atMost({std::max(a.low, b.low), std::max(a.high, b.high)});
    case Op::Power:
    case Op::Rol:
    case Op::Ror: return anything;
  }
  return anything;
}

}  // namespace rung::ir
