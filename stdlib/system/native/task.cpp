// Native bodies of task.st: the current task, and messages to the operator.
#include "rung/code.h"

extern "C" {

uint32_t rung_system_HOST_TASK(rung_context* ctx) { return ctx->task; }
uint32_t rung_system_HOST_ACTIVATION(rung_context* ctx) { return ctx->activation; }

int64_t rung_system_HOST_INTERVAL(rung_context* ctx) {
  return ctx->task == 0 || ctx->task > ctx->module->task_count ? 0 : ctx->module->tasks[ctx->task - 1].interval_ns;
}

uint32_t rung_system_HOST_PROJECT(rung_context* ctx, char* out, uint32_t capacity) {
  size_t length = strlen(ctx->module->name);
  if (length > capacity) length = capacity;
  memcpy(out, ctx->module->name, length);
  out[length] = 0;
  return static_cast<uint32_t>(length);
}

uint8_t rung_system_HOST_MESSAGE(rung_context* ctx, uint8_t severity, const char* text) {
  if (ctx->host == nullptr || ctx->host->message == nullptr) return 0;
  ctx->host->message(ctx->host_data, severity, text);
  return 1;
}

}  // extern "C"
