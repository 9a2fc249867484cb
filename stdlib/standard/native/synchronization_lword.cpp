// SPDX-License-Identifier: Apache-2.0
// The native body of synchronization.st that is atomic in 64 bits. Many processors of 32 bits cannot do that: alone in
// its file, it wants a function of the product (__atomic_compare_exchange_8) only from programs that call it.
#include "rung/code.h"

extern "C" uint8_t rung_standard_HOST_SWAP_LWORD(rung_context*, uint64_t* value, uint64_t old, uint64_t wanted) {
  return __atomic_compare_exchange_n(value, &old, wanted, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE) ? 1 : 0;
}
