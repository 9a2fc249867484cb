// SPDX-License-Identifier: Apache-2.0
// Native bodies of diagnosis.st, on the table of the host.
#include "rung/diagnosis.h"

#include "rung/code.h"

namespace {

rung_diagnosis* tableOf(const rung_context* ctx) { return ctx->host == nullptr ? nullptr : ctx->host->diagnosis; }

}  // namespace

extern "C" {

uint8_t rung_system_HOST_FAULT_REPORT(rung_context* ctx, uint32_t code, uint32_t source) {
  return rung_report_fault(tableOf(ctx), code, source, ctx->now_ns) ? 1 : 0;
}

uint8_t rung_system_HOST_FAULT_CLEAR(rung_context* ctx, uint32_t code, uint32_t source) {
  return rung_clear_fault(tableOf(ctx), code, source) ? 1 : 0;
}

uint8_t rung_system_HOST_FAULT(rung_context* ctx, uint32_t number, uint32_t* code, uint32_t* source, int64_t* since) {
  rung_current_fault faults[RUNG_DIAGNOSIS_ENTRIES];
  const bool found = number < rung_current_faults(tableOf(ctx), faults, RUNG_DIAGNOSIS_ENTRIES);
  *code = found ? faults[number].code : 0;
  *source = found ? faults[number].source : 0;
  *since = found ? faults[number].since_ns : 0;
  return found ? 1 : 0;
}

uint8_t rung_system_HOST_INDICATORS(rung_context* ctx) { return rung_indicators(tableOf(ctx)); }
uint8_t rung_system_HOST_DISPLAY(rung_context* ctx) { return rung_display_code(tableOf(ctx)); }

}  // extern "C"
