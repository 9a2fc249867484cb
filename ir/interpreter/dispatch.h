// SPDX-License-Identifier: Apache-2.0
// How one instruction reaches the next, and how instructions read and write their operands. Optimized builds jump from
// instruction to instruction (a call in tail position), which costs one indirect jump each; without optimization or
// with sanitizers, where such a call would need stack, each returns to the loop of execute().
#pragma once

#include <type_traits>

#include "ir/interpreter/code.h"
#include "rung/code.h"

#if defined(__clang__)
#define RUNG_INTERPRETER_JUMPS 1
#define RUNG_TAIL_CALL [[clang::musttail]] return
#elif defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define RUNG_INTERPRETER_JUMPS 1
#define RUNG_TAIL_CALL return
#else
#define RUNG_INTERPRETER_JUMPS 0
#define RUNG_TAIL_CALL return
#endif

#define RUNG_HANDLER_PARAMETERS \
  [[maybe_unused]] const Insn *ip, [[maybe_unused]] uint8_t *fp, [[maybe_unused]] uint8_t *self, Machine *m
#if RUNG_INTERPRETER_JUMPS
#define RUNG_GO(next, frame, instance)                        \
  do {                                                        \
    const Insn* const go_to = (next);                         \
    RUNG_TAIL_CALL go_to->run(go_to, (frame), (instance), m); \
  } while (0)
#else
#define RUNG_GO(next, frame, instance) \
  do {                                 \
    m->ip = (next);                    \
    m->fp = (frame);                   \
    m->self = (instance);              \
    return;                            \
  } while (0)
#endif
#define RUNG_NEXT RUNG_GO(ip + 1, fp, self)
#define RUNG_JUMP RUNG_GO(ip + static_cast<int32_t>(ip->d), fp, self)

namespace rung::ir::interpreter {

struct Truth {};  // BOOL: one byte, read as != 0

// Memory of any type at any address.
template <class T>
struct __attribute__((packed, may_alias)) Cell {
  T value;
};
template <class T>
inline T load(const uint8_t* at) {
  return reinterpret_cast<const Cell<T>*>(at)->value;
}
template <class T>
inline void store(uint8_t* at, T value) {
  reinterpret_cast<Cell<T>*>(at)->value = value;
}

template <class T>
struct RawOf {
  using Type = T;
};
template <>
struct RawOf<Truth> {
  using Type = uint8_t;
};
template <class T>
using Raw = typename RawOf<T>::Type;

template <class T>
inline Raw<T> fetch(const uint8_t* at) {
  if constexpr (std::is_same_v<T, Truth>) {
    return load<uint8_t>(at) != 0 ? 1 : 0;
  } else {
    return load<T>(at);
  }
}

template <class T>
inline Raw<T> ofImmediate(int64_t imm) {
  if constexpr (std::is_same_v<T, float>) {
    return rung_f32_of(static_cast<uint32_t>(imm));
  } else if constexpr (std::is_same_v<T, double>) {
    return rung_f64_of(static_cast<uint64_t>(imm));
  } else {
    return static_cast<Raw<T>>(imm);
  }
}

template <Mode M, class T>
inline Raw<T> get(const Insn* ip, const uint8_t* fp, const uint8_t* self, uint32_t offset) {
  if constexpr (M == Mode::Frame) return fetch<T>(fp + offset);
  if constexpr (M == Mode::Self) return fetch<T>(self + offset);
  return ofImmediate<T>(ip->imm);
}
template <Mode M, class T>
inline void put(uint8_t* fp, uint8_t* self, uint32_t offset, Raw<T> value) {
  static_assert(M != Mode::Constant);
  store<Raw<T>>((M == Mode::Frame ? fp : self) + offset, value);
}
template <Base B>
inline uint8_t* address(const Insn* ip, uint8_t* fp, uint8_t* self, uint32_t offset) {
  if constexpr (B == Base::Frame) return fp + offset;
  if constexpr (B == Base::Self) return self + offset;
  if constexpr (B == Base::Pointer) return load<uint8_t*>(fp + offset);
  return reinterpret_cast<uint8_t*>(ip->imm);
}

// Leaves the interpreted code as a native check does. `site` counts from 1.
[[noreturn, gnu::cold, gnu::noinline]] void fail(Machine* m, const uint8_t* fp, const uint8_t* self,
                                                 rung_fault_kind kind, uint32_t site, int64_t value);

}  // namespace rung::ir::interpreter
