/* SPDX-License-Identifier: Apache-2.0 */
/* Functions of the standard that work on many types, for bodies in C++: ADD, LIMIT, MUX, SHL, LEN and so on, in upper
 * case like all functions there. In: values of the types of rung/cpp.h. Out: templates with IEC semantics: integers
 * wrap, x / 0 is 0, SEL and MUX choose. Functions of one type are generated for each body instead. */
#ifndef RUNG_CPP_FUNCTIONS_H
#define RUNG_CPP_FUNCTIONS_H

#include <math.h>
#include <stdint.h>

#include <type_traits>

#include "rung/code.h"
#include "rung/real_functions.h"

namespace rung {
namespace cpp {

template <class... Values>
using Common = std::common_type_t<Values...>;
template <class T>
constexpr bool kIsInteger = std::is_integral<T>::value && !std::is_same<T, bool>::value;

/* Computes integers as unsigned, so that they wrap. */
template <class T, class Operation>
T wrapped(T a, T b, Operation operation) {
  if constexpr (kIsInteger<T>) {
    return static_cast<T>(operation(static_cast<uint64_t>(a), static_cast<uint64_t>(b)));
  } else {
    return static_cast<T>(operation(a, b));
  }
}
/* The operation over two values, then over the result and the next. */
template <class Operation, class A, class B, class... More>
auto folded(Operation operation, A a, B b, More... more) {
  const auto first = wrapped<Common<A, B>>(a, b, operation);
  if constexpr (sizeof...(More) == 0) {
    return first;
  } else {
    return folded(operation, first, more...);
  }
}
template <class... Values>
auto ADD(Values... values) {
  return folded([](auto x, auto y) { return x + y; }, values...);
}
template <class... Values>
auto MUL(Values... values) {
  return folded([](auto x, auto y) { return x * y; }, values...);
}
template <class A, class B>
Common<A, B> SUB(A a, B b) {
  return wrapped<Common<A, B>>(a, b, [](auto x, auto y) { return x - y; });
}
template <class A, class B>
Common<A, B> DIV(A a, B b) {
  using T = Common<A, B>;
  if constexpr (!kIsInteger<T>) {
    return static_cast<T>(a) / static_cast<T>(b);
  } else if constexpr (std::is_signed<T>::value) {
    return static_cast<T>(rung_div_i64(a, b));
  } else {
    return static_cast<T>(rung_div_u64(a, b));
  }
}
template <class A, class B>
Common<A, B> MOD(A a, B b) {
  using T = Common<A, B>;
  static_assert(kIsInteger<T>, "MOD works on integers");
  if constexpr (std::is_signed<T>::value) {
    return static_cast<T>(rung_mod_i64(a, b));
  } else {
    return static_cast<T>(rung_mod_u64(a, b));
  }
}
template <class T>
T ABS(T a) {
  if constexpr (!kIsInteger<T>) {
    return a < 0 ? -a : a;
  } else if constexpr (std::is_signed<T>::value) {
    return static_cast<T>(rung_abs_i64(a));
  } else {
    return a;
  }
}
template <class T>
T MOVE(T a) {
  return a;
}

template <class A, class B>
Common<A, B> MIN(A a, B b) {
  return static_cast<Common<A, B>>(b) < static_cast<Common<A, B>>(a) ? b : a;
}
template <class A, class B, class... More>
auto MIN(A a, B b, More... more) {
  return MIN(MIN(a, b), more...);
}
template <class A, class B>
Common<A, B> MAX(A a, B b) {
  return static_cast<Common<A, B>>(a) < static_cast<Common<A, B>>(b) ? b : a;
}
template <class A, class B, class... More>
auto MAX(A a, B b, More... more) {
  return MAX(MAX(a, b), more...);
}
template <class Low, class Value, class High>
auto LIMIT(Low low, Value value, High high) {
  return MIN(MAX(value, low), high);
}
template <class A, class B>
Common<A, B> SEL(bool second, A a, B b) {
  return second ? static_cast<Common<A, B>>(b) : static_cast<Common<A, B>>(a);
}
/* The last one when `which` is out of range. */
template <class A, class... More>
Common<A, More...> MUX(int64_t which, A a, More... more) {
  const Common<A, More...> values[] = {static_cast<Common<A, More...>>(a), static_cast<Common<A, More...>>(more)...};
  constexpr int64_t kLast = sizeof...(More);
  return values[which < 0 || which > kLast ? kLast : which];
}

template <class A, class B>
bool GT(A a, B b) {
  return b < a;
}
template <class A, class B>
bool GE(A a, B b) {
  return b <= a;
}
template <class A, class B>
bool EQ(A a, B b) {
  return a == b;
}
template <class A, class B>
bool LE(A a, B b) {
  return a <= b;
}
template <class A, class B>
bool LT(A a, B b) {
  return a < b;
}
template <class A, class B>
bool NE(A a, B b) {
  return !(a == b);
}

template <class T>
T SHL(T a, uint64_t n) {
  return static_cast<T>(rung_shl64(static_cast<std::make_unsigned_t<T>>(a), n));
}
// A signed integer is filled with its sign.
template <class T>
T SHR(T a, uint64_t n) {
  if constexpr (std::is_signed_v<T>) return static_cast<T>(rung_sar(a, n));
  return static_cast<T>(rung_shr64(static_cast<std::make_unsigned_t<T>>(a), n));
}
template <class T>
T ROL(T a, uint64_t n) {
  constexpr uint64_t kBits = 8 * sizeof(T);
  n %= kBits;
  using Bits = std::make_unsigned_t<T>;
  const auto bits = static_cast<Bits>(a);
  return n == 0 ? a : static_cast<T>(SHL(bits, n) | SHR(bits, kBits - n));
}
template <class T>
T ROR(T a, uint64_t n) {
  constexpr uint64_t kBits = 8 * sizeof(T);
  return ROL(a, kBits - n % kBits);
}

#define RUNG_CPP_REAL_FUNCTION(name, function)                                                \
  inline float name(float a) { return static_cast<float>(function(static_cast<double>(a))); } \
  inline double name(double a) { return function(a); }
RUNG_EACH_REAL_FUNCTION(RUNG_CPP_REAL_FUNCTION)
#undef RUNG_CPP_REAL_FUNCTION
template <class A, class B>
A EXPT(A a, B b) {
  return static_cast<A>(pow(static_cast<double>(a), static_cast<double>(b)));
}

}  // namespace cpp
}  // namespace rung

#endif
