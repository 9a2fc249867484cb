// SPDX-License-Identifier: Apache-2.0
// Native bodies of instances.st.
#include "rung/change.h"
#include "rung/code.h"

extern "C" uint8_t rung_standard_HOST_COPIES(rung_context* ctx, void* instance) {
  return rung_in_copy_code(ctx, instance) ? 1 : 0;
}
