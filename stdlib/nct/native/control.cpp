// SPDX-License-Identifier: Apache-2.0
// Native bodies of control.st and simulation.st: each forwards its call to the host's numerical control.
#include "rung/nc.h"

#include <math.h>
#include <string.h>

#include "rung/code.h"
#include "rung/reals.h"

namespace {

const rung_nc* controlOf(const rung_context* ctx) { return ctx->host == nullptr ? nullptr : ctx->host->nc; }

uint32_t* areaOf(const rung_context* ctx, char letter) {
  const rung_module& module = *ctx->module;
  for (uint32_t i = 0; i < module.areas.count; ++i) {
    const char* const name = module.strings + rung_area_at(&module, i)->name;
    if (name[0] == letter && name[1] == '\0') return reinterpret_cast<uint32_t*>(ctx->areas[i]);
  }
  return nullptr;
}

// A number with `digits` decimals, halves away from zero. `to` has RUNG_REAL_PRINT_ROOM characters. Returns its length.
uint32_t printReal(char* to, double value, uint32_t digits) {
  uint32_t length = 0;
  if (!isfinite(value)) return rung_real_format(value, false, to);
  const double scaled = fabs(value) * static_cast<double>(2u << digits);
  // Only a number of so few binary digits is exactly between two of `digits` decimals; there `f` gives the even one.
  const bool is_tie = scaled < 9007199254740992.0 && fmod(scaled, 2) == 1;
  uint64_t bits;
  double magnitude = fabs(value);
  memcpy(&bits, &magnitude, sizeof bits);
  bits += is_tie ? 1 : 0;  // the next greater number
  memcpy(&magnitude, &bits, sizeof bits);
  length = rung_real_print(magnitude, 'f', digits, false, to + 1);
  bool is_zero = true;
  for (uint32_t k = 1; k <= length; ++k) is_zero = is_zero && (to[k] == '0' || to[k] == '.');
  if (value < 0 && !is_zero) {
    to[0] = '-';
    return length + 1;
  }
  memmove(to, to + 1, length);
  return length;
}

// The item at the beginning of `text`, `{#0:F0}` or `{*0:F2}`: its length, or 0. NCT manual 6.13.
size_t itemLength(const char* text, uint32_t& digits) {
  if (text[0] != '{' || (text[1] != '#' && text[1] != '*') || strncmp(text + 2, "0:F", 3) != 0) return 0;
  size_t at = 5;
  digits = 0;
  for (; text[at] >= '0' && text[at] <= '9' && at < 7; ++at)
    digits = digits * 10 + static_cast<uint32_t>(text[at] - '0');
  if (at == 5 || text[at] != '}') return 0;
  if (text[1] == '#') digits = 0;
  return at + 1;
}

// `text` with its item printed.
void printText(const char* text, double value, char (&to)[512]) {
  size_t length = 0;
  while (*text != '\0' && length + 1 < sizeof to) {
    uint32_t digits = 0;
    const size_t item = itemLength(text, digits);
    if (item == 0) {
      to[length++] = *text++;
      continue;
    }
    char number[RUNG_REAL_PRINT_ROOM + 1];
    const uint32_t size = printReal(number, value, digits);
    for (uint32_t k = 0; k < size && length + 1 < sizeof to; ++k) to[length++] = number[k];
    text += item;
  }
  to[length] = '\0';
}

}  // namespace

extern "C" {

uint8_t rung_nct_NCT_CONTROL_EXCHANGE(rung_context* ctx, uint32_t* nonvolatile, uint8_t cycle) {
  const rung_nc* const nc = controlOf(ctx);
  uint32_t* const slice = areaOf(ctx, 'T');
  if (nc == nullptr || slice == nullptr) return 0;
  nc->exchange(ctx->host->nc_data, slice, nonvolatile, cycle != 0, ctx->now_ns);
  return 1;
}

uint8_t rung_nct_NCT_CONTROL_TITLE(rung_context* ctx, uint32_t button, const char* text) {
  const rung_nc* const nc = controlOf(ctx);
  if (nc == nullptr || nc->title == nullptr) return 0;
  nc->title(ctx->host->nc_data, button, text);
  return 1;
}

int32_t rung_nct_NCT_CONTROL_MESSAGE(rung_context* ctx, uint8_t event, uint8_t kind, uint32_t code, const char* text,
                                     int32_t integer, double real) {
  const rung_nc* const nc = controlOf(ctx);
  if (nc == nullptr || nc->message == nullptr || nc->withdraw == nullptr) return RUNG_NC_REFUSED;
  char printed[512] = "";
  if (event == 1) printText(text, (kind & 4) != 0 ? real : static_cast<double>(integer), printed);
  const rung_nc_message message = {code, static_cast<uint8_t>(kind & 1), static_cast<uint8_t>(kind >> 1 & 1), printed};
  if (event == 2) {
    nc->withdraw(ctx->host->nc_data, &message);
    return RUNG_NC_DONE;
  }
  return nc->message(ctx->host->nc_data, &message, event == 1);
}

int32_t rung_nct_NCT_CONTROL_MOVE(rung_context* ctx, int32_t axis, int32_t code, double speed, double distance) {
  const rung_nc* const nc = controlOf(ctx);
  return nc == nullptr || nc->move == nullptr ? RUNG_NC_REFUSED
                                              : nc->move(ctx->host->nc_data, axis, code, speed, distance);
}

uint8_t rung_nct_NCT_CONTROL_READ_MACRO(rung_context* ctx, int32_t channel, int32_t number, double* value) {
  const rung_nc* const nc = controlOf(ctx);
  *value = 0;
  return nc != nullptr && nc->read_macro != nullptr &&
                 nc->read_macro(ctx->host->nc_data, channel, number, value) == RUNG_NC_DONE
             ? 1
             : 0;
}

uint8_t rung_nct_NCT_CONTROL_WRITE_MACRO(rung_context* ctx, int32_t channel, int32_t number, double value) {
  const rung_nc* const nc = controlOf(ctx);
  return nc != nullptr && nc->write_macro != nullptr &&
                 nc->write_macro(ctx->host->nc_data, channel, number, value) == RUNG_NC_DONE
             ? 1
             : 0;
}

uint8_t rung_nct_NCT_CONTROL_SCOPE(rung_context* ctx, int32_t scope, int32_t first, int32_t second, double* value) {
  const rung_nc* const nc = controlOf(ctx);
  *value = 0;
  return nc != nullptr && nc->scope != nullptr &&
                 nc->scope(ctx->host->nc_data, scope, first, second, value) == RUNG_NC_DONE
             ? 1
             : 0;
}

uint32_t rung_nct_NCT_CONTROL_SUBMIT(rung_context* ctx, uint8_t writes, int32_t service, uint32_t address,
                                     uint32_t count) {
  const rung_nc* const nc = controlOf(ctx);
  const uint32_t* const memory = areaOf(ctx, 'N');
  if (nc == nullptr || nc->submit == nullptr || nc->poll == nullptr || memory == nullptr) return 0;
  const rung_nc_request request = {writes, service, address, count, memory + address};
  return nc->submit(ctx->host->nc_data, &request);
}

uint8_t rung_nct_NCT_CONTROL_POLL(rung_context* ctx, uint32_t number) {
  const rung_nc* const nc = controlOf(ctx);
  uint32_t* const memory = areaOf(ctx, 'N');
  if (nc == nullptr || nc->poll == nullptr || memory == nullptr) return 1;
  return nc->poll(ctx->host->nc_data, number, memory) ? 1 : 0;
}

uint8_t rung_nct_NCT_CONTROL_CANCEL(rung_context* ctx, uint32_t number) {
  const rung_nc* const nc = controlOf(ctx);
  if (nc == nullptr || nc->cancel == nullptr) return 0;
  nc->cancel(ctx->host->nc_data, number);
  return 1;
}

uint8_t rung_nct_NCT_SIMULATE_VALUES(rung_context* ctx, int32_t what, double a, double b, double c, double d, double e,
                                     double f, double* result) {
  const rung_nc* const nc = controlOf(ctx);
  *result = 0;
  if (nc == nullptr || nc->simulate == nullptr) return 0;
  const double values[] = {a, b, c, d, e, f};
  return nc->simulate(ctx->host->nc_data, what, values, 6, result) == RUNG_NC_DONE ? 1 : 0;
}

uint32_t rung_nct_NCT_SIMULATED_CODE(rung_context* ctx, int32_t place, int32_t row) {
  const rung_nc* const nc = controlOf(ctx);
  char text[256];
  return nc == nullptr || nc->text == nullptr ? 0 : nc->text(ctx->host->nc_data, place, row, text);
}

uint32_t rung_nct_NCT_SIMULATED_TEXT(rung_context* ctx, int32_t place, int32_t row, char* out, uint32_t capacity) {
  const rung_nc* const nc = controlOf(ctx);
  char text[256] = "";
  if (nc != nullptr && nc->text != nullptr) nc->text(ctx->host->nc_data, place, row, text);
  uint32_t length = 0;
  for (; length < capacity && text[length] != '\0'; ++length) out[length] = text[length];
  out[length] = '\0';
  return length;
}

}  // extern "C"
