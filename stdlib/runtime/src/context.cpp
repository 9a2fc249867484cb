// SPDX-License-Identifier: Apache-2.0
// Entering and leaving generated code: a fault is a longjmp to the innermost guard, or an exception up to the outermost
// (rung/call_paths.h). In: the context of a task. Out: the
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

struct Initialisation {
  rung_context* ctx;
  const rung_initialiser* row;
  void* instance;
};
void initialise(void* initialisation) {
  const auto* const it = static_cast<const Initialisation*>(initialisation);
  it->row->init(it->ctx, it->instance);
}

uint8_t guard(rung_context* ctx, void (*run)(void* frame), void* frame) {
  ctx->fault.kind = RUNG_FAULT_NONE;
  ctx->cpp_body = nullptr;
  ctx->caller_count = 0;
  ctx->steps = ctx->step_limit > 0 ? ctx->step_limit : INT64_MAX;
  return rung_try(ctx, run, frame);
}

}  // namespace

uint8_t rung_guarded(rung_context* ctx, void (*run)(rung_context*)) {
  Activation activation{ctx, run};
  return guard(ctx, activate, &activation);
}

uint8_t rung_init_instance(rung_context* ctx, uint32_t type, void* instance) {
  const rung_module* const module = ctx->module;
  memset(instance, 0, rung_type_at(module, type)->size);
  for (uint32_t i = 0; i < module->initialisers.count; ++i) {
    const auto* const row = static_cast<const rung_initialiser*>(rung_row(&module->initialisers, i));
    if (row->type != type) continue;
    ctx->entry = row;
    Initialisation initialisation{ctx, row, instance};
    return guard(ctx, initialise, &initialisation);
  }
  return RUNG_FAULT_NONE;
}

[[noreturn]] static void leave(rung_context* ctx) {
  const bool stops = ctx->fault.kind == RUNG_FAULT_STOP;
  longjmp(*static_cast<jmp_buf*>(stops ? ctx->stop_target : ctx->fault_target), 1);
}

static void setFault(rung_context* ctx, uint8_t kind, uint32_t site, int64_t value) {
  ctx->fault.kind = kind;
  ctx->fault.site = site;
  ctx->fault.value = value;
  if (ctx->fault_target == nullptr)
    __builtin_trap();  // the host called generated code without a guard: a bug of the host
  if (kind != RUNG_FAULT_STOP) return;
  ctx->fault.value = ctx->stop;
  if (ctx->stop == RUNG_STOP_NONE) ctx->fault.value = RUNG_STOP_STEPS;
}

void rung_raise(rung_context* ctx, uint8_t kind, uint32_t site, int64_t value) {
  setFault(ctx, kind, site, value);
  if (ctx->fault_target != ctx->stop_target) leave(ctx);  // a __TRY handles it
  const rung_module* const module = ctx->module;
  ctx->caller_count = 0;
  if (module != nullptr && module->find_callers != nullptr) module->find_callers(ctx);
  if (ctx->host != nullptr && ctx->host->faulted != nullptr) ctx->host->faulted(ctx->host_data, ctx);
  if (module != nullptr && module->throw_fault != nullptr) module->throw_fault();
  leave(ctx);
}

void rung_raise_crash(rung_context* ctx, uint8_t kind, uint32_t site, int64_t value) {
  setFault(ctx, kind, site, value);
  ctx->caller_count = 0;
  leave(ctx);
}

extern "C" void rung_called(rung_context* ctx, uint32_t site, const void* instance) {
  if (ctx->caller_count < RUNG_CALLERS) ctx->callers[ctx->caller_count] = {site, instance};
  ++ctx->caller_count;
}

extern "C" void rung_leave(rung_context* ctx) { leave(ctx); }

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
    if (outer == nullptr && ctx->module != nullptr && ctx->module->run_catching != nullptr)
      ctx->module->run_catching(ctx, run, frame);
    else
      run(frame);
    ctx->fault_target = outer;
    return RUNG_FAULT_NONE;
  }
  ctx->fault_target = outer;
  return ctx->fault.kind;
}
