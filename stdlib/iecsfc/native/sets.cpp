// SPDX-License-Identifier: Apache-2.0
// Native bodies of sfc.st.
#include "rung/code.h"

extern "C" {

int16_t rung_iecsfc_SFCTakeBit(rung_context*, uint64_t* set) {
  if (*set == 0) return 0;
  const auto lowest = static_cast<int16_t>(__builtin_ctzll(*set));
  *set &= *set - 1;
  return lowest;
}

}  // extern "C"
