// SPDX-License-Identifier: Apache-2.0
// Turns values known when the translator runs into template arguments: calls f with a type or with constants of Mode.
// Used by the handlers_*.cpp to choose among their instantiations.
#pragma once

#include "ir/interpreter/dispatch.h"
#include "ir/interpreter/handlers.h"

namespace rung::ir::interpreter {

template <auto V>
using Is = std::integral_constant<decltype(V), V>;

// A value that is one of those listed; of another there is no handler.
template <auto... Listed, class T, class F>
Handler withOneOf(T value, F&& f) {
  Handler found = nullptr;
  static_cast<void>(((value == Listed && (found = f(Is<Listed>{}), true)) || ...));
  return found;
}

template <class F>
Handler withUnsigned(uint32_t size, F&& f) {
  if (size == 1) return f(uint8_t{});
  if (size == 2) return f(uint16_t{});
  if (size == 4) return f(uint32_t{});
  return f(uint64_t{});
}

template <class F>
Handler withInteger(Scalar type, F&& f) {
  switch (type) {
    case Scalar::I8: return f(int8_t{});
    case Scalar::I16: return f(int16_t{});
    case Scalar::I32: return f(int32_t{});
    case Scalar::I64: return f(int64_t{});
    case Scalar::Bool:
    case Scalar::U8: return f(uint8_t{});
    case Scalar::U16: return f(uint16_t{});
    case Scalar::U32: return f(uint32_t{});
    case Scalar::U64:
    case Scalar::F32:
    case Scalar::F64: break;
  }
  return f(uint64_t{});
}

template <class F>
Handler withNumber(Scalar type, F&& f) {
  if (type == Scalar::F32) return f(float{});
  if (type == Scalar::F64) return f(double{});
  return withInteger(type, f);
}

template <class F>
Handler withAny(Scalar type, F&& f) {
  if (type == Scalar::Bool) return f(Truth{});
  return withNumber(type, f);
}

// Copies of memory: a BOOL becomes 0 or 1.
template <class F>
Handler withWidth(Scalar type, F&& f) {
  if (type == Scalar::Bool) return f(Truth{});
  return withUnsigned(sizeOf(type), f);
}

template <class F>
Handler withTarget(Mode to, F&& f) {  // a target is never a constant
  return to == Mode::Frame ? f(Is<Mode::Frame>{}) : f(Is<Mode::Self>{});
}
template <class F>
Handler withSource(Mode from, F&& f) {
  if (from == Mode::Constant) return f(Is<Mode::Constant>{});
  return withTarget(from, f);
}
template <class F>
Handler withModes(Mode from, Mode to, F&& f) {
  return withTarget(from, [&](auto a) { return withTarget(to, [&](auto d) { return f(a, d); }); });
}
// Two constants never meet: the passes and the translator ensure that.
template <class F>
Handler withModes(Mode left, Mode right, Mode to, F&& f) {
  return withTarget(to, [&](auto d) {
    if (left == Mode::Constant) return withTarget(right, [&](auto b) { return f(Is<Mode::Constant>{}, b, d); });
    return withTarget(left, [&](auto a) { return withSource(right, [&](auto b) { return f(a, b, d); }); });
  });
}

template <class F>
Handler withAddress(Base base, F&& f) {  // of a target
  if (base == Base::Frame) return f(Is<Base::Frame>{});
  if (base == Base::Self) return f(Is<Base::Self>{});
  return f(Is<Base::Pointer>{});
}
template <class F>
Handler withAnyAddress(Base base, F&& f) {
  if (base == Base::Constant) return f(Is<Base::Constant>{});
  return withAddress(base, f);
}

}  // namespace rung::ir::interpreter
