// SPDX-License-Identifier: Apache-2.0
// Native bodies of channels.st: each forwards its call to the host's channels. Without such a host, opening is denied.
#include "rung/code.h"
#include "rung/modbus.h"

namespace {

const rung_channels* channelsOf(const rung_context* ctx) {
  return ctx->host == nullptr ? nullptr : ctx->host->channels;
}

}  // namespace

extern "C" {

int64_t rung_system_HOST_CHANNEL_OPEN(rung_context* ctx, uint8_t kind, const char* address, uint16_t port,
                                      int64_t server, uint32_t rate, uint8_t data_bits, uint8_t parity,
                                      uint8_t stop_bits, uint8_t unit) {
  const rung_channels* const channels = channelsOf(ctx);
  if (channels == nullptr) return RUNG_CHANNEL_DENIED;
  const rung_channel_settings settings = {kind, port, address, server, rate, data_bits, parity, stop_bits, unit};
  return channels->open(ctx->host->channels_data, &settings);
}

int64_t rung_system_HOST_CHANNEL_STATUS(rung_context* ctx, int64_t channel, uint32_t* readable, uint32_t* unsent) {
  const rung_channels* const channels = channelsOf(ctx);
  rung_channel_status status = {RUNG_CHANNEL_HANDLE, 0, 0};
  if (channels != nullptr && channels->status(ctx->host->channels_data, channel, &status) < 0)
    status.state = RUNG_CHANNEL_HANDLE;
  *readable = status.readable;
  *unsent = status.unsent;
  return status.state;
}

int64_t rung_system_HOST_CHANNEL_READ(rung_context* ctx, int64_t channel, uintptr_t buffer, uint32_t count,
                                      uint32_t* address, uint16_t* port) {
  const rung_channels* const channels = channelsOf(ctx);
  rung_endpoint from = {0, 0};
  const int64_t result =
      channels == nullptr || buffer == 0
          ? int64_t{RUNG_CHANNEL_HANDLE}
          : channels->read(ctx->host->channels_data, channel, reinterpret_cast<void*>(buffer), count, &from);
  *address = from.address;
  *port = from.port;
  return result;
}

int64_t rung_system_HOST_CHANNEL_WRITE(rung_context* ctx, int64_t channel, uintptr_t buffer, uint32_t count,
                                       uint32_t address, uint16_t port) {
  const rung_channels* const channels = channelsOf(ctx);
  if (channels == nullptr || buffer == 0) return RUNG_CHANNEL_HANDLE;
  const rung_endpoint to = {address, port};
  return channels->write(ctx->host->channels_data, channel, reinterpret_cast<const void*>(buffer), count, &to);
}

int64_t rung_system_HOST_CHANNEL_CLOSE(rung_context* ctx, int64_t channel) {
  const rung_channels* const channels = channelsOf(ctx);
  return channels == nullptr ? int64_t{RUNG_CHANNEL_HANDLE} : channels->close(ctx->host->channels_data, channel);
}

uint32_t rung_system_HOST_ADDRESS(rung_context* ctx, char* out, uint32_t capacity) {
  const char* const address = ctx->host == nullptr ? nullptr : ctx->host->address;
  const char* const text = address == nullptr ? "0.0.0.0" : address;
  size_t length = strlen(text);
  if (length > capacity) length = capacity;
  memcpy(out, text, length);
  out[length] = 0;
  return static_cast<uint32_t>(length);
}

uint16_t rung_system_HOST_MODBUS_CRC(rung_context*, uintptr_t buffer, uint32_t count) {
  return buffer == 0 ? uint16_t{0xffff} : rung_modbus_crc(reinterpret_cast<const uint8_t*>(buffer), count);
}

}  // extern "C"
