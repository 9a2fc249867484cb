/* SPDX-License-Identifier: Apache-2.0 */
/* Who called the code that faults. A fault leaves compiled code by a jump to rung_guarded, so its callers never see it.
 * With -DRUNG_CALL_PATHS it leaves as a C++ exception instead, which each call notes on its way
 * (rung_context::callers): nothing is executed for that until there is a fault, but the module needs the C++ runtime.
 * In: the calls of generated code. Out: rung_context::callers. */
#ifndef RUNG_CALL_PATHS_H
#define RUNG_CALL_PATHS_H

#include "rung/module.h"

#ifdef RUNG_CALL_PATHS

struct __attribute__((visibility("hidden"))) rung_unwinding {};

/* Notes a call: the POU that faults is inside it. */
extern "C" void rung_called(rung_context* ctx, uint32_t site, const void* instance);
/* To the end of rung_guarded. */
extern "C" __attribute__((noreturn)) void rung_leave(rung_context* ctx);

/* Around each call of a POU. */
#define RUNG_CALL try {
#define RUNG_CALLED(site, instance)       \
  }                                       \
  catch (const rung_unwinding&) {         \
    rung_called(ctx, (site), (instance)); \
    throw;                                \
  }

__attribute__((visibility("hidden"))) inline void rung_run_catching(rung_context* ctx, void (*run)(void*),
                                                                    void* frame) {
  try {
    run(frame);
    return;
  } catch (const rung_unwinding&) {
  }
  rung_leave(ctx);
}
__attribute__((visibility("hidden"))) inline void rung_throw_fault() { throw rung_unwinding(); }
#define RUNG_CALL_PATH_FUNCTIONS rung_run_catching, rung_throw_fault

#else

#define RUNG_CALL {
#define RUNG_CALLED(site, instance) }
#define RUNG_CALL_PATH_FUNCTIONS nullptr, nullptr

#endif
#endif
