// SPDX-License-Identifier: Apache-2.0
// Moves, loads, stores, elements of arrays and addresses: see handlers.h.
#include <cstring>

#include "ir/interpreter/dispatch.h"
#include "ir/interpreter/handlers.h"
#include "ir/interpreter/select.h"

namespace rung::ir::interpreter {

namespace {

template <class T, Mode A, Mode D>
void move(RUNG_HANDLER_PARAMETERS) {
  put<D, T>(fp, self, ip->a, get<A, T>(ip, fp, self, ip->b));
  RUNG_NEXT;
}

template <class T, Mode D>
void loadAt(RUNG_HANDLER_PARAMETERS) {
  put<D, T>(fp, self, ip->a, fetch<T>(load<uint8_t*>(fp + ip->b) + ip->c));
  RUNG_NEXT;
}

template <class T, Mode A>
void storeAt(RUNG_HANDLER_PARAMETERS) {
  store<Raw<T>>(load<uint8_t*>(fp + ip->a) + ip->b, get<A, T>(ip, fp, self, ip->c));
  RUNG_NEXT;
}

// The position of an element, counted from the lowest index (low half of imm), below the count (high half). Without a
// check it may be outside, and so may the memory, as in native code.
template <class I, Mode M>
uint64_t position(const Insn* ip, const uint8_t* fp, const uint8_t* self, Machine* m) {
  const I index = get<M, I>(ip, fp, self, ip->c);
  const auto at = static_cast<uint64_t>(static_cast<int64_t>(index)) -
                  static_cast<uint64_t>(int64_t{static_cast<int32_t>(ip->imm)});
  if (RUNG_UNLIKELY(at >= static_cast<uint64_t>(ip->imm) >> 32) && ip->d != 0) {
    fail(m, fp, self, RUNG_FAULT_INDEX, ip->d, static_cast<int64_t>(index));
  }
  return at;
}

template <class T, class I, Base B, Mode M, Mode D>
void loadElementOfTwo(RUNG_HANDLER_PARAMETERS) {
  const uint64_t row = position<I, M>(ip, fp, self, m), column = position<I, M>(ip + 1, fp, self, m);
  put<D, T>(fp, self, ip->a, fetch<T>(address<B>(ip, fp, self, ip->b) + row * ip[1].a + column * sizeof(Raw<T>)));
  RUNG_GO(ip + 2, fp, self);
}

template <class T, class I, Base B, Mode M, Mode D>
void loadElement(RUNG_HANDLER_PARAMETERS) {
  const uint64_t at = position<I, M>(ip, fp, self, m);
  put<D, T>(fp, self, ip->a, fetch<T>(address<B>(ip, fp, self, ip->b) + at * sizeof(Raw<T>)));
  RUNG_NEXT;
}

template <class T, class I, Base B, Mode M, Mode A>
void storeElement(RUNG_HANDLER_PARAMETERS) {
  const uint64_t at = position<I, M>(ip, fp, self, m);
  store<Raw<T>>(address<B>(ip, fp, self, ip->b) + at * sizeof(Raw<T>), get<A, T>(ip, fp, self, ip->a));
  RUNG_NEXT;
}

template <class I, Base B, Mode M>
void element(RUNG_HANDLER_PARAMETERS) {
  const I index = get<M, I>(ip, fp, self, ip->c);
  const uint64_t at = static_cast<uint64_t>(static_cast<int64_t>(index)) - static_cast<uint64_t>(ip[1].imm);
  if (RUNG_UNLIKELY(at >= static_cast<uint64_t>(ip->imm)) && ip->d != 0) {
    fail(m, fp, self, RUNG_FAULT_INDEX, ip->d, static_cast<int64_t>(index));
  }
  store<uint8_t*>(fp + ip->a, address<B>(ip, fp, self, ip->b) + at * ip[1].a + ip[1].b);
  RUNG_GO(ip + 2, fp, self);
}

template <Base B>
void lea(RUNG_HANDLER_PARAMETERS) {
  store<uint8_t*>(fp + ip->a, address<B>(ip, fp, self, ip->b) + ip->c);
  RUNG_NEXT;
}

void checkNull(RUNG_HANDLER_PARAMETERS) {
  if (RUNG_UNLIKELY(load<uint8_t*>(fp + ip->b) == nullptr)) {
    fail(m, fp, self, static_cast<rung_fault_kind>(ip->a), ip->d, 0);
  }
  RUNG_NEXT;
}

void loadBit(RUNG_HANDLER_PARAMETERS) {
  store<uint8_t>(fp + ip->a, load<uint8_t*>(fp + ip->b)[ip->c] >> ip->d & 1);
  RUNG_NEXT;
}
void storeBit(RUNG_HANDLER_PARAMETERS) {
  rung_put_bit(load<uint8_t*>(fp + ip->a) + ip->b, ip->d, load<uint8_t>(fp + ip->c) != 0);
  RUNG_NEXT;
}

template <Base D, Base A>
void copy(RUNG_HANDLER_PARAMETERS) {
  memmove(address<D>(ip, fp, self, ip->a), address<A>(ip, fp, self, ip->b), ip->c);
  RUNG_NEXT;
}
template <Base D>
void clear(RUNG_HANDLER_PARAMETERS) {
  memset(address<D>(ip, fp, self, ip->a), 0, ip->c);
  RUNG_NEXT;
}

void block(RUNG_HANDLER_PARAMETERS) {
  store<void*>(fp + ip->a, m->ctx->blocks[ip->b]);
  RUNG_NEXT;
}
void image(RUNG_HANDLER_PARAMETERS) {
  store<uint8_t*>(fp + ip->a, m->ctx->areas[ip->b]);
  RUNG_NEXT;
}

template <class T>
void select(RUNG_HANDLER_PARAMETERS) {
  store<T>(fp + ip->a, load<uint8_t>(fp + ip->d) != 0 ? load<T>(fp + ip->b) : load<T>(fp + ip->c));
  RUNG_NEXT;
}

void compareMemory(RUNG_HANDLER_PARAMETERS) {
  const bool same = memcmp(load<uint8_t*>(fp + ip->b), load<uint8_t*>(fp + ip->d), ip->c) == 0;
  store<uint8_t>(fp + ip->a, same ? 1 : 0);
  RUNG_NEXT;
}

// Other types are widened to 64 bits first.
template <class F>
Handler withIndex(Scalar type, F&& f) {
  if (type == Scalar::I16) return f(int16_t{});
  if (type == Scalar::I32) return f(int32_t{});
  return f(int64_t{});
}

}  // namespace

Handler moveHandler(Scalar type, Mode from, Mode to) {
  return withWidth(type, [&]<class T>(T) {
    return withTarget(to,
                      [&](auto d) { return withSource(from, [&](auto a) -> Handler { return move<T, a(), d()>; }); });
  });
}
Handler loadHandler(Scalar type, Mode to) {
  return withWidth(type, [&]<class T>(T) { return withTarget(to, [](auto d) -> Handler { return loadAt<T, d()>; }); });
}
Handler storeHandler(Scalar type, Mode from) {
  return withWidth(type,
                   [&]<class T>(T) { return withSource(from, [](auto a) -> Handler { return storeAt<T, a()>; }); });
}
Handler loadElementHandler(Scalar type, Scalar index, Base base, Mode index_mode, Mode to) {
  return withWidth(type, [&]<class T>(T) {
    return withIndex(index, [&]<class I>(I) {
      return withAddress(base, [&](auto b) {
        return withModes(index_mode, to, [&](auto i, auto d) -> Handler { return loadElement<T, I, b(), i(), d()>; });
      });
    });
  });
}
Handler loadElementOfTwoHandler(Scalar type, Scalar index, Base base, Mode index_mode, Mode to) {
  return withWidth(type, [&]<class T>(T) {
    return withAddress(base, [&](auto b) {
      return withModes(index_mode, to, [&](auto i, auto d) -> Handler {
        if (index == Scalar::I16) return loadElementOfTwo<T, int16_t, b(), i(), d()>;
        return loadElementOfTwo<T, int32_t, b(), i(), d()>;
      });
    });
  });
}
Handler storeElementHandler(Scalar type, Scalar index, Base base, Mode index_mode, Mode from) {
  return withWidth(type, [&]<class T>(T) {
    return withIndex(index, [&]<class I>(I) {
      return withAddress(base, [&](auto b) {
        return withModes(index_mode, from,
                         [&](auto i, auto a) -> Handler { return storeElement<T, I, b(), i(), a()>; });
      });
    });
  });
}
Handler elementHandler(Scalar index, Base base, Mode index_mode) {
  return withIndex(index, [&]<class I>(I) {
    return withAddress(
        base, [&](auto b) { return withTarget(index_mode, [&](auto i) -> Handler { return element<I, b(), i()>; }); });
  });
}
Handler leaHandler(Base base) {
  return withAnyAddress(base, [](auto b) -> Handler { return lea<b()>; });
}
Handler checkNullHandler() { return checkNull; }
Handler loadBitHandler() { return loadBit; }
Handler storeBitHandler() { return storeBit; }
Handler copyHandler(Base to, Base from) {
  return withAddress(to,
                     [&](auto d) { return withAnyAddress(from, [&](auto a) -> Handler { return copy<d(), a()>; }); });
}
Handler clearHandler(Base to) {
  return withAddress(to, [](auto d) -> Handler { return clear<d()>; });
}
Handler blockHandler() { return block; }
Handler imageHandler() { return image; }
Handler selectHandler(Scalar type) {
  return withUnsigned(sizeOf(type), []<class T>(T) -> Handler { return select<T>; });
}
Handler compareMemoryHandler() { return compareMemory; }

}  // namespace rung::ir::interpreter
