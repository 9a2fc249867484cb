// Entering and leaving generated code: a fault is a longjmp to the innermost guard. In: the context of a task. Out: the
// kind of fault, details in ctx->fault. Called by hosts for each activation, and by checks of generated code.
// Nothing with a destructor may live across a call into generated code.
#include <setjmp.h>
#include <stdint.h>

#include "rung/code.h"

namespace {

struct Activation {
  rung_context* ctx;
  void (*run)(rung_context*);
};
void activate(void* activation) {
  const auto* const it = static_cast<const Activation*>(activation);
  it->run(it->ctx);
}

}  // namespace

uint8_t rung_guarded(rung_context* ctx, void (*run)(rung_context*)) {
  Activation activation{ctx, run};
  ctx->fault.kind = RUNG_FAULT_NONE;
  ctx->cpp_body = nullptr;
  ctx->steps = ctx->step_limit > 0 ? ctx->step_limit : INT64_MAX;
  return rung_try(ctx, activate, &activation);
}

void rung_raise(rung_context* ctx, uint8_t kind, uint32_t site, int64_t value) {
  ctx->fault.kind = kind;
  ctx->fault.site = site;
  ctx->fault.value = value;
  if (ctx->fault_target == nullptr)
    __builtin_trap();  // the host called generated code without a guard: a bug of the host
  const bool stops = kind == RUNG_FAULT_STOP;
  if (stops) ctx->fault.value = ctx->stop;
  if (stops && ctx->stop == RUNG_STOP_NONE) ctx->fault.value = RUNG_STOP_STEPS;
  longjmp(*static_cast<jmp_buf*>(stops ? ctx->stop_target : ctx->fault_target), 1);
}

bool rung_poll(rung_context* ctx) {
  if (ctx->stop != RUNG_STOP_NONE || ctx->step_limit > 0) return true;
  ctx->steps = INT64_MAX;  // no limit
  return false;
}

uint8_t rung_try(rung_context* ctx, void (*run)(void* frame), void* frame) {
  jmp_buf target;
  void* const outer = ctx->fault_target;
  ctx->fault_target = &target;
  if (outer == nullptr) ctx->stop_target = &target;
  // Locals do not change after setjmp, so they are all still valid after longjmp.
  if (setjmp(target) == 0) {
    run(frame);
    ctx->fault_target = outer;
    return RUNG_FAULT_NONE;
  }
  ctx->fault_target = outer;
  return ctx->fault.kind;
}
