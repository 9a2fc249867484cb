// SPDX-License-Identifier: Apache-2.0
// Operators, conversions and their checks: see handlers.h. They agree with the arithmetic kernel bit for bit
// (tests/unit/ir/interpreter), as the helpers of rung/code.h do, which they share with generated code.
#include <cmath>
#include <limits>

#include "ir/interpreter/dispatch.h"
#include "ir/interpreter/handlers.h"
#include "ir/interpreter/select.h"

namespace rung::ir::interpreter {

namespace {

template <class T>
using Unsigned = std::make_unsigned_t<T>;

struct Add {
  template <class T>
  static T of(T a, T b) {
    if constexpr (std::is_floating_point_v<T>) return a + b;
    if constexpr (!std::is_floating_point_v<T>) return static_cast<T>(uint64_t{a} + uint64_t{b});
  }
};
struct Sub {
  template <class T>
  static T of(T a, T b) {
    if constexpr (std::is_floating_point_v<T>) return a - b;
    if constexpr (!std::is_floating_point_v<T>) return static_cast<T>(uint64_t{a} - uint64_t{b});
  }
};
struct Mul {
  template <class T>
  static T of(T a, T b) {
    if constexpr (std::is_floating_point_v<T>) return a * b;
    if constexpr (!std::is_floating_point_v<T>) return static_cast<T>(uint64_t{a} * uint64_t{b});
  }
};
struct And {
  template <class T>
  static T of(T a, T b) {
    return static_cast<T>(a & b);
  }
};
struct Or {
  template <class T>
  static T of(T a, T b) {
    return static_cast<T>(a | b);
  }
};
struct Xor {
  template <class T>
  static T of(T a, T b) {
    return static_cast<T>(a ^ b);
  }
};
struct Min {
  template <class T>
  static T of(T a, T b) {
    return b < a ? b : a;
  }
};
struct Max {
  template <class T>
  static T of(T a, T b) {
    return b > a ? b : a;
  }
};
struct DivReal {
  template <class T>
  static T of(T a, T b) {
    return a / b;
  }
};
struct ModReal {
  template <class T>
  static T of(T a, T b) {
    return std::fmod(a, b);
  }
};

template <class O, class T, Mode A, Mode B, Mode D>
void binary(RUNG_HANDLER_PARAMETERS) {
  put<D, T>(fp, self, ip->a, O::of(get<A, T>(ip, fp, self, ip->b), get<B, T>(ip, fp, self, ip->c)));
  RUNG_NEXT;
}

template <bool IsDiv, class T, Mode A, Mode B, Mode D>
void divide(RUNG_HANDLER_PARAMETERS) {
  const T a = get<A, T>(ip, fp, self, ip->b), b = get<B, T>(ip, fp, self, ip->c);
  T result = 0;
  if (RUNG_UNLIKELY(b == 0)) {
    if (ip->d != 0) fail(m, fp, self, RUNG_FAULT_DIV, ip->d, 0);
  } else if constexpr (std::is_signed_v<T>) {
    if (RUNG_UNLIKELY(b == -1)) {
      result = IsDiv ? Sub::of<Unsigned<T>>(0, static_cast<Unsigned<T>>(a)) : 0;
    } else {
      result = static_cast<T>(IsDiv ? a / b : a % b);
    }
  } else {
    result = static_cast<T>(IsDiv ? a / b : a % b);
  }
  put<D, T>(fp, self, ip->a, result);
  RUNG_NEXT;
}

template <Op O, class T, Mode A, Mode B, Mode D>
void shift(RUNG_HANDLER_PARAMETERS) {
  const T a = get<A, T>(ip, fp, self, ip->b);
  const uint64_t n = get<B, uint64_t>(ip, fp, self, ip->c);
  constexpr uint32_t width = sizeof(T) * 8;
  T result;
  if constexpr (O == Op::Shl) {
    result = n >= width ? 0 : static_cast<T>(uint64_t{a} << n);
  } else if constexpr (O == Op::Shr) {
    result = n >= width ? 0 : static_cast<T>(uint64_t{a} >> n);
  } else if constexpr (O == Op::Sar) {
    result = static_cast<T>(rung_sar(static_cast<std::make_signed_t<T>>(a), n));
  } else {
    const uint64_t by = (O == Op::Rol ? n : 0 - n) & (width - 1);
    result = static_cast<T>(uint64_t{a} << by | uint64_t{a} >> ((width - by) & (width - 1)));
  }
  put<D, T>(fp, self, ip->a, result);
  RUNG_NEXT;
}

template <Op O, class T, Mode A, Mode D>
void unary(RUNG_HANDLER_PARAMETERS) {
  const Raw<T> a = get<A, T>(ip, fp, self, ip->b);
  Raw<T> result;
  if constexpr (O == Op::Not) {
    result = std::is_same_v<T, Truth> ? a ^ 1 : static_cast<Raw<T>>(~a);
  } else if constexpr (std::is_floating_point_v<Raw<T>>) {
    result = O == Op::Neg ? -a : std::fabs(a);
  } else if constexpr (O == Op::Neg) {
    result = static_cast<Raw<T>>(0 - static_cast<uint64_t>(a));
  } else {
    result = a < 0 ? static_cast<Raw<T>>(0 - static_cast<uint64_t>(a)) : a;
  }
  put<D, T>(fp, self, ip->a, result);
  RUNG_NEXT;
}

template <class From, class To>
Raw<To> converted(Raw<From> x) {
  using F = Raw<From>;
  using R = Raw<To>;
  if constexpr (std::is_same_v<To, Truth>) {
    if constexpr (std::is_floating_point_v<F>) return x < 0 || x > 0;  // FALSE for NaN
    return x != 0;
  } else if constexpr (std::is_floating_point_v<F> && std::is_same_v<R, uint64_t>) {
    return rung_round_u64(static_cast<double>(x));
  } else if constexpr (std::is_floating_point_v<F> && !std::is_floating_point_v<R>) {
    return static_cast<R>(rung_round(static_cast<double>(x), static_cast<int64_t>(std::numeric_limits<R>::min()),
                                     static_cast<int64_t>(std::numeric_limits<R>::max())));
  } else {
    return static_cast<R>(x);
  }
}

template <class From, class To, Mode A, Mode D>
void convert(RUNG_HANDLER_PARAMETERS) {
  put<D, To>(fp, self, ip->a, converted<From, To>(get<A, From>(ip, fp, self, ip->b)));
  RUNG_NEXT;
}

template <class T, class E>
void power(RUNG_HANDLER_PARAMETERS) {
  const T base = load<T>(fp + ip->b);
  const E exponent = load<E>(fp + ip->c);
  if constexpr (std::is_floating_point_v<T>) {
    store<T>(fp + ip->a, static_cast<T>(rung_power(static_cast<double>(base), static_cast<double>(exponent))));
  } else {
    store<T>(fp + ip->a, static_cast<T>(rung_integer_power(static_cast<uint64_t>(static_cast<int64_t>(base)),
                                                           static_cast<uint64_t>(exponent), exponent < 0)));
  }
  RUNG_NEXT;
}

// ---- checks

template <Op O, class T>
void overflow(RUNG_HANDLER_PARAMETERS) {
  const T a = load<T>(fp + ip->b);
  bool bad = false;
  int64_t value = 0;
  if constexpr (std::is_floating_point_v<T>) {
    T result, b = 0;
    if constexpr (O != Op::Neg && O != Op::Abs) b = load<T>(fp + ip->c);
    if constexpr (O == Op::Add) result = a + b;
    if constexpr (O == Op::Sub) result = a - b;
    if constexpr (O == Op::Mul) result = a * b;
    if constexpr (O == Op::Div) result = a / b;
    if constexpr (O == Op::Mod) result = std::fmod(a, b);
    if constexpr (O == Op::Power) {
      result = static_cast<T>(rung_power(static_cast<double>(a), static_cast<double>(b)));
    }
    if constexpr (O == Op::Neg || O == Op::Abs) result = a;
    bad = std::isinf(result) && std::isfinite(a) && std::isfinite(b);
  } else if constexpr (O == Op::Add || O == Op::Sub || O == Op::Mul || O == Op::Neg) {
    T result;
    if constexpr (O == Op::Neg) {
      bad = __builtin_sub_overflow(T{0}, a, &result);
    } else {
      const T b = load<T>(fp + ip->c);
      if constexpr (O == Op::Add) bad = __builtin_add_overflow(a, b, &result);
      if constexpr (O == Op::Sub) bad = __builtin_sub_overflow(a, b, &result);
      if constexpr (O == Op::Mul) bad = __builtin_mul_overflow(a, b, &result);
    }
    value = static_cast<int64_t>(result);
  } else if constexpr ((O == Op::Div || O == Op::Abs) && std::is_signed_v<T>) {
    bad = a == std::numeric_limits<T>::min();
    if constexpr (O == Op::Div) bad = bad && load<T>(fp + ip->c) == -1;
    value = static_cast<int64_t>(a);
  }
  if (RUNG_UNLIKELY(bad)) fail(m, fp, self, RUNG_FAULT_OVERFLOW, ip->d, value);
  RUNG_NEXT;
}

template <rung_fault_kind Kind, class T>
void range(RUNG_HANDLER_PARAMETERS) {
  const T value = load<T>(fp + ip->b);
  if (RUNG_UNLIKELY(value < static_cast<T>(ip[1].imm) || value > static_cast<T>(ip[2].imm))) {
    fail(m, fp, self, Kind, ip->d, static_cast<int64_t>(value));
  }
  RUNG_GO(ip + 3, fp, self);
}

template <bool Saturates>
void whole(RUNG_HANDLER_PARAMETERS) {
  const double value = load<double>(fp + ip->b);
  store<int64_t>(fp + ip->a, Saturates ? rung_whole_i64(value) : static_cast<int64_t>(rung_whole(value)));
  RUNG_NEXT;
}

template <bool Even>
void roundedRange(RUNG_HANDLER_PARAMETERS) {
  const double value = load<double>(fp + ip->b);
  const double low = rung_f64_of(static_cast<uint64_t>(ip[1].imm)),
               high = rung_f64_of(static_cast<uint64_t>(ip[2].imm));
  if (RUNG_UNLIKELY(Even ? rung_round_saturates(value, low, high) : rung_whole_wraps(value, low, high)))
    fail(m, fp, self, RUNG_FAULT_CONVERT, ip->d, Even ? rung_round_i64(value) : rung_whole_i64(value));
  RUNG_GO(ip + 3, fp, self);
}

template <class T>
void zeroPower(RUNG_HANDLER_PARAMETERS) {
  if (RUNG_UNLIKELY(load<T>(fp + ip->b) == 0 && load<int64_t>(fp + ip->c) < 0))
    fail(m, fp, self, RUNG_FAULT_DIV, ip->d, 0);
  RUNG_NEXT;
}

// ---- selection

template <class O, class T>
Handler binaryOf(Mode left, Mode right, Mode to) {
  return withModes(left, right, to, [](auto a, auto b, auto d) -> Handler { return binary<O, T, a(), b(), d()>; });
}
template <class O>
Handler modular(Scalar type, Mode left, Mode right, Mode to) {  // the same for both signs
  switch (sizeOf(type)) {
    case 1: return binaryOf<O, uint8_t>(left, right, to);
    case 2: return binaryOf<O, uint16_t>(left, right, to);
    case 4: return binaryOf<O, uint32_t>(left, right, to);
    default: return binaryOf<O, uint64_t>(left, right, to);
  }
}
template <class O>
Handler modularOrReal(Scalar type, Mode left, Mode right, Mode to) {
  if (type == Scalar::F32) return binaryOf<O, float>(left, right, to);
  if (type == Scalar::F64) return binaryOf<O, double>(left, right, to);
  return modular<O>(type, left, right, to);
}
template <class O>
Handler bitwise(Scalar type, Mode left, Mode right, Mode to) {
  return type == Scalar::Bool ? binaryOf<O, Truth>(left, right, to) : modular<O>(type, left, right, to);
}
template <class O>
Handler ordered(Scalar type, Mode left, Mode right, Mode to) {
  return withNumber(type, [&]<class T>(T) { return binaryOf<O, T>(left, right, to); });
}
template <bool IsDiv>
Handler quotient(Scalar type, Mode left, Mode right, Mode to) {
  using Real = std::conditional_t<IsDiv, DivReal, ModReal>;
  if (type == Scalar::F32) return binaryOf<Real, float>(left, right, to);
  if (type == Scalar::F64) return binaryOf<Real, double>(left, right, to);
  return withInteger(type, [&]<class T>(T) {
    return withModes(left, right, to,
                     [](auto a, auto b, auto d) -> Handler { return divide<IsDiv, T, a(), b(), d()>; });
  });
}

template <Op O>
Handler shiftOf(Scalar type, Mode left, Mode right, Mode to) {
  return withUnsigned(sizeOf(type), [&]<class T>(T) {
    return withModes(left, right, to, [](auto a, auto b, auto d) -> Handler {
      if constexpr (a() == Mode::Constant || b() == Mode::Self) return nullptr;
      if constexpr (a() != Mode::Constant && b() != Mode::Self) return shift<O, T, a(), b(), d()>;
    });
  });
}

template <Op O, class T>
Handler unaryOf(Mode from, Mode to) {
  return withModes(from, to, [](auto a, auto d) -> Handler { return unary<O, T, a(), d()>; });
}

template <Op O>
Handler overflowOf(Scalar type) {
  return withNumber(type, []<class T>(T) -> Handler { return overflow<O, T>; });
}

}  // namespace

Handler binaryHandler(Op op, Scalar type, Mode left, Mode right, Mode to) {
  struct Row {
    Op op;
    Handler (*handler)(Scalar type, Mode left, Mode right, Mode to);
  };
  static constexpr Row kRows[] = {{Op::Add, modularOrReal<Add>}, {Op::Sub, modularOrReal<Sub>},
                                  {Op::Mul, modularOrReal<Mul>}, {Op::Div, quotient<true>},
                                  {Op::Mod, quotient<false>},    {Op::And, bitwise<And>},
                                  {Op::Or, bitwise<Or>},         {Op::Xor, bitwise<Xor>},
                                  {Op::Min, ordered<Min>},       {Op::Max, ordered<Max>}};
  for (const Row& row : kRows)
    if (row.op == op) return row.handler(type, left, right, to);
  return nullptr;
}

Handler shiftHandler(Op op, Scalar type, Mode left, Mode right, Mode to) {
  if (op == Op::Shl) return shiftOf<Op::Shl>(type, left, right, to);
  if (op == Op::Shr) return shiftOf<Op::Shr>(type, left, right, to);
  if (op == Op::Sar) return shiftOf<Op::Sar>(type, left, right, to);
  if (op == Op::Rol) return shiftOf<Op::Rol>(type, left, right, to);
  return shiftOf<Op::Ror>(type, left, right, to);
}

Handler unaryHandler(Op op, Scalar type, Mode from, Mode to) {
  if (op == Op::Not) {
    if (type == Scalar::Bool) return unaryOf<Op::Not, Truth>(from, to);
    return withUnsigned(sizeOf(type), [&]<class T>(T) { return unaryOf<Op::Not, T>(from, to); });
  }
  return withNumber(
      type, [&]<class T>(T) { return op == Op::Neg ? unaryOf<Op::Neg, T>(from, to) : unaryOf<Op::Abs, T>(from, to); });
}

Handler convertHandler(Scalar from, Scalar to, Mode source, Mode target) {
  const bool narrows = !isReal(from) && !isReal(to) && from != Scalar::Bool && to != Scalar::Bool;
  if (from == to || (narrows && sizeOf(to) <= sizeOf(from))) return nullptr;
  return withAny(from, [&]<class From>(From) {
    return withAny(to, [&]<class To>(To) {
      return withModes(source, target, [](auto a, auto d) -> Handler { return convert<From, To, a(), d()>; });
    });
  });
}

Handler powerHandler(Scalar base, Scalar exponent) {
  return withNumber(base, [&]<class T>(T) -> Handler {
    if constexpr (std::is_floating_point_v<T>) return power<T, double>;
    if constexpr (!std::is_floating_point_v<T>) return exponent == Scalar::I64 ? power<T, int64_t> : power<T, uint64_t>;
  });
}

Handler overflowHandler(Op op, Scalar type) {
  return withOneOf<Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Mod, Op::Power, Op::Neg, Op::Abs>(
      op, [&](auto o) { return overflowOf<o()>(type); });
}

Handler rangeHandler(rung_fault_kind kind, bool is_signed) {
  if (kind == RUNG_FAULT_CONVERT) {
    return is_signed ? range<RUNG_FAULT_CONVERT, int64_t> : range<RUNG_FAULT_CONVERT, uint64_t>;
  }
  return is_signed ? range<RUNG_FAULT_SUBRANGE, int64_t> : range<RUNG_FAULT_SUBRANGE, uint64_t>;
}
Handler roundedRangeHandler(types::Rounding rounding) {
  return rounding == types::Rounding::ToEven ? roundedRange<true> : roundedRange<false>;
}
Handler wholeHandler(bool saturates) { return saturates ? whole<true> : whole<false>; }
Handler zeroPowerHandler(Scalar base) {
  return withInteger(base, []<class T>(T) -> Handler { return zeroPower<T>; });
}

}  // namespace rung::ir::interpreter
