// SPDX-License-Identifier: Apache-2.0
// Comparisons, branches, loops and switches: see handlers.h.
#include <limits>

#include "ir/interpreter/dispatch.h"
#include "ir/interpreter/handlers.h"
#include "ir/interpreter/select.h"

namespace rung::ir::interpreter {

namespace {

template <Op O, class T>
bool holds(T a, T b) {
  if constexpr (O == Op::Eq) return a == b;
  if constexpr (O == Op::Ne) return a != b;
  if constexpr (O == Op::Lt) return a < b;
  if constexpr (O == Op::Le) return a <= b;
  if constexpr (O == Op::Gt) return a > b;
  return a >= b;
}

template <Op O, class T, Mode A, Mode B, Mode D>
void compare(RUNG_HANDLER_PARAMETERS) {
  const bool result = holds<O>(get<A, T>(ip, fp, self, ip->b), get<B, T>(ip, fp, self, ip->c));
  put<D, Truth>(fp, self, ip->a, result ? 1 : 0);
  RUNG_NEXT;
}

template <Op O, class T, Mode A, Mode B, bool Sense>
void branch(RUNG_HANDLER_PARAMETERS) {
  if (holds<O>(get<A, T>(ip, fp, self, ip->a), get<B, T>(ip, fp, self, ip->b)) == Sense) RUNG_JUMP;
  RUNG_NEXT;
}

template <Mode A, bool Sense>
void branchTruth(RUNG_HANDLER_PARAMETERS) {
  if ((get<A, Truth>(ip, fp, self, ip->a) != 0) == Sense) RUNG_JUMP;
  RUNG_NEXT;
}

// The next value; or false and the limit of the type when it does not fit.
template <class T, bool Up>
bool advance(T& control, int64_t step) {
  T next;
  if (RUNG_UNLIKELY(__builtin_add_overflow(control, step, &next))) {
    control = Up ? std::numeric_limits<T>::max() : std::numeric_limits<T>::min();
    return false;
  }
  control = next;
  return true;
}

template <class T, bool Up, Mode C>
void forStep(RUNG_HANDLER_PARAMETERS) {
  T control = get<C, T>(ip, fp, self, ip->a);
  const bool fits = advance<T, Up>(control, ip->imm);
  put<C, T>(fp, self, ip->a, control);
  const T limit = load<T>(fp + ip->b);
  if (fits && (Up ? control <= limit : control >= limit)) RUNG_JUMP;
  RUNG_NEXT;
}

template <class T, bool Up>
void forFlag(RUNG_HANDLER_PARAMETERS) {
  T control = load<T>(fp + ip->a);
  const bool fits = advance<T, Up>(control, ip->imm);
  store<T>(fp + ip->a, control);
  const T limit = load<T>(fp + ip->b);
  store<uint8_t>(fp + ip->c, fits && (Up ? control <= limit : control >= limit) ? 1 : 0);
  RUNG_NEXT;
}

template <class T, Mode A>
void switchTable(RUNG_HANDLER_PARAMETERS) {
  const uint64_t at = static_cast<uint64_t>(get<A, T>(ip, fp, self, ip->a)) - static_cast<uint64_t>(ip[1].imm);
  if (at < ip->c) RUNG_GO(ip + reinterpret_cast<const int32_t*>(ip->imm)[at], fp, self);
  RUNG_JUMP;
}

template <class T, Mode A>
void switchRanges(RUNG_HANDLER_PARAMETERS) {
  const uint64_t flip = std::is_signed_v<T> ? uint64_t{1} << 63 : 0;
  const uint64_t value = static_cast<uint64_t>(get<A, T>(ip, fp, self, ip->a)) ^ flip;
  const SwitchRange* const ranges = reinterpret_cast<const SwitchRange*>(ip->imm);
  uint32_t low = 0, high = ip->c;  // the first range whose high is not below the value
  while (low < high) {
    const uint32_t middle = (low + high) / 2;
    if (ranges[middle].high < value) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low < ip->c && ranges[low].low <= value) RUNG_GO(ip + ranges[low].to, fp, self);
  RUNG_JUMP;
}

template <Op O, class T>
Handler compareOf(Mode left, Mode right, Mode to) {
  return withTarget(to, [&](auto d) {
    return withTarget(left, [&](auto a) {
      return withSource(right, [&](auto b) -> Handler { return compare<O, T, a(), b(), d()>; });
    });
  });
}
template <Op O, class T>
Handler branchOf(Mode left, Mode right, bool sense) {
  return withTarget(left, [&](auto a) {
    return withSource(
        right, [&](auto b) -> Handler { return sense ? branch<O, T, a(), b(), true> : branch<O, T, a(), b(), false>; });
  });
}

// Equality of integers does not depend on the sign, and the opposite of a comparison of integers is another comparison.
template <Op O, class F>
Handler withCompared(Scalar type, F&& f) {
  const bool is_equality = O == Op::Eq || O == Op::Ne;
  if (type == Scalar::Bool) return f(Truth{});
  if (is_equality && !isReal(type)) return withUnsigned(sizeOf(type), f);
  return withNumber(type, f);
}

template <class F>
Handler withComparison(Op op, F&& f) {
  return withOneOf<Op::Eq, Op::Ne, Op::Lt, Op::Le, Op::Gt, Op::Ge>(op, f);
}

}  // namespace

Handler compareHandler(Op op, Scalar type, Mode left, Mode right, Mode to) {
  return withComparison(op, [&](auto o) {
    return withCompared<o()>(type, [&]<class T>(T) { return compareOf<o(), T>(left, right, to); });
  });
}
Handler branchHandler(Op op, Scalar type, Mode left, Mode right, bool sense) {
  return withComparison(op, [&](auto o) {
    return withCompared<o()>(type, [&]<class T>(T) { return branchOf<o(), T>(left, right, sense); });
  });
}
Handler branchTruthHandler(Mode mode, bool sense) {
  return withTarget(mode, [&](auto a) -> Handler { return sense ? branchTruth<a(), true> : branchTruth<a(), false>; });
}
Handler forHandler(Scalar type, bool up, Mode control) {
  return withInteger(type, [&]<class T>(T) {
    return withTarget(control, [&](auto c) -> Handler { return up ? forStep<T, true, c()> : forStep<T, false, c()>; });
  });
}
Handler forFlagHandler(Scalar type, bool up) {
  return withInteger(type, [&]<class T>(T) -> Handler { return up ? forFlag<T, true> : forFlag<T, false>; });
}
Handler switchHandler(Scalar type, Mode mode) {
  return withInteger(
      type, [&]<class T>(T) { return withTarget(mode, [](auto a) -> Handler { return switchTable<T, a()>; }); });
}
Handler switchRangesHandler(Scalar type, Mode mode) {
  return withInteger(
      type, [&]<class T>(T) { return withTarget(mode, [](auto a) -> Handler { return switchRanges<T, a()>; }); });
}

}  // namespace rung::ir::interpreter
