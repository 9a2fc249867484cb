// SPDX-License-Identifier: Apache-2.0
// Native bodies of hsio.st: each forwards its call to the host's registers.
#include "rung/code.h"

extern "C" {

int64_t rung_system_HOST_HSIO_READ(rung_context* ctx, uint32_t item, uint32_t index) {
  const rung_hsio* const hsio = ctx->host == nullptr ? nullptr : ctx->host->hsio;
  return hsio == nullptr ? 0 : hsio->read(ctx->host->hsio_data, item, index, ctx->now_ns);
}

uint8_t rung_system_HOST_HSIO_WRITE(rung_context* ctx, uint32_t item, uint32_t index, int64_t value) {
  const rung_hsio* const hsio = ctx->host == nullptr ? nullptr : ctx->host->hsio;
  return hsio != nullptr && hsio->write(ctx->host->hsio_data, item, index, value, ctx->now_ns) ? 1 : 0;
}

}  // extern "C"
