// SPDX-License-Identifier: Apache-2.0
// Native bodies of clock.st and network.st.
#include "rung/code.h"

extern "C" {

int64_t rung_system_HOST_CLOCK(rung_context* ctx) {
  return ctx->host == nullptr || ctx->host->wall_clock == nullptr ? ctx->now_ns : ctx->host->wall_clock(ctx->host_data);
}

uint8_t rung_system_HOST_CLOCK_SET(rung_context* ctx, int64_t time) {
  return ctx->host != nullptr && ctx->host->set_wall_clock != nullptr && ctx->host->set_wall_clock(ctx->host_data, time)
             ? 1
             : 0;
}

uint8_t rung_system_HOST_NETWORK(rung_context* ctx, uint32_t port, uint32_t* address, uint32_t* mask,
                                 uint32_t* gateway) {
  rung_network found = {};
  const bool known =
      ctx->host != nullptr && ctx->host->network != nullptr && ctx->host->network(ctx->host_data, port, &found);
  *address = known ? found.address : 0;
  *mask = known ? found.mask : 0;
  *gateway = known ? found.gateway : 0;
  return known ? 1 : 0;
}

uint8_t rung_system_HOST_NETWORK_SET(rung_context* ctx, uint32_t port, uint32_t address, uint32_t mask,
                                     uint32_t gateway) {
  const rung_network wanted = {address, mask, gateway};
  return ctx->host != nullptr && ctx->host->set_network != nullptr &&
                 ctx->host->set_network(ctx->host_data, port, &wanted)
             ? 1
             : 0;
}

}  // extern "C"
