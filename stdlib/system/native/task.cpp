// SPDX-License-Identifier: Apache-2.0
// Native bodies of task.st: the current task, messages to the operator, and names.
#include "rung/code.h"

namespace {

uint32_t copyText(const char* text, char* out, uint32_t capacity) {
  size_t length = strlen(text);
  if (length > capacity) length = capacity;
  memcpy(out, text, length);
  out[length] = 0;
  return static_cast<uint32_t>(length);
}

}  // namespace

extern "C" {

uint32_t rung_system_HOST_TASK(rung_context* ctx) { return ctx->task; }
uint32_t rung_system_HOST_ACTIVATION(rung_context* ctx) { return ctx->activation; }

int64_t rung_system_HOST_INTERVAL(rung_context* ctx) {
  return ctx->task == 0 || ctx->task > ctx->module->tasks.count ? 0
                                                                : rung_task_at(ctx->module, ctx->task - 1)->interval_ns;
}

uint8_t rung_system_HOST_TASK_STATISTICS(rung_context* ctx, uint32_t task, uint32_t* activations, uint32_t* overruns,
                                         int64_t* last, int64_t* shortest, int64_t* average, int64_t* longest,
                                         int64_t* earliest, int64_t* latest) {
  rung_task_state state = {};
  const bool known = ctx->task_states != nullptr && task > 0 && task <= ctx->module->tasks.count;
  if (known) state = ctx->task_states[task - 1];
  *activations = state.activations;
  *overruns = state.overruns;
  *last = state.last_ns;
  *shortest = state.shortest_ns;
  *average = state.activations == 0 ? 0 : state.total_ns / state.activations;
  *longest = state.longest_ns;
  *earliest = state.earliest_ns;
  *latest = state.latest_ns;
  return known ? 1 : 0;
}

uint32_t rung_system_HOST_PROJECT(rung_context* ctx, char* out, uint32_t capacity) {
  return copyText(ctx->module->name, out, capacity);
}

uint32_t rung_system_HOST_NAME(rung_context* ctx, char* out, uint32_t capacity) {
  const char* const name = ctx->host == nullptr ? nullptr : ctx->host->name;
  return copyText(name == nullptr ? "" : name, out, capacity);
}

uint8_t rung_system_HOST_MESSAGE(rung_context* ctx, uint8_t severity, const char* text) {
  if (ctx->host == nullptr || ctx->host->message == nullptr) return 0;
  ctx->host->message(ctx->host_data, severity, text);
  return 1;
}

}  // extern "C"
