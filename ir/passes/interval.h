// SPDX-License-Identifier: Apache-2.0
// Intervals of integer values, for range analysis. In: the intervals of operands. Out: the interval of the result of
// IEC arithmetic, wrap-around included. 128 bits hold every value of every type, and sums and products of two.
#pragma once

#include "sema/types/arithmetic.h"

namespace rung::ir {

using Int128 = __int128;

struct Interval {
  Int128 low = 0, high = 0;
  bool isEmpty() const { return low > high; }
  bool contains(Int128 value) const { return low <= value && value <= high; }
  bool within(const Interval& outer) const { return outer.low <= low && high <= outer.high; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

inline Interval join(const Interval& a, const Interval& b) {
  return {a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}
inline Interval meet(const Interval& a, const Interval& b) {
  return {a.low > b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
}

// All values of a BOOL, integer, bit string, enumeration or subrange. `with_bounds`: a subrange's bounds hold. For any
// other type an interval that proves nothing.
Interval intervalOf(const types::TypeTable& types, TypeId type, bool with_bounds);
bool hasInterval(const types::TypeTable& types, TypeId type);

// The result of an operator whose operands lie in these intervals; `type` has all values of its type. `fits`: the exact
// result always lies inside the type, so nothing wraps.
struct IntervalResult {
  Interval interval;
  bool fits = false;
};
IntervalResult apply(types::Op op, const Interval& a, const Interval& b, const Interval& type);

}  // namespace rung::ir
