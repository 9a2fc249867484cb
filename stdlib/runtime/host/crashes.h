// SPDX-License-Identifier: Apache-2.0
// Crashes of the program: it accesses memory through a bad pointer, or calls of compiled code nest too deep. The signal
// becomes a fault like any other (rung/module.h), so outputs get safe values and __TRY sees it.
// In: the activation, the signal. Out: RUNG_FAULT_NULL with RUNG_BAD_ADDRESS, or RUNG_FAULT_STACK.
#pragma once

#include "rung/host.h"

namespace rung::host {

// rung_guarded, with these signals as faults once catchCrashes has been called.
uint8_t guarded(rung_context* ctx, void (*run)(rung_context*));

// The context that this thread runs, or null.
rung_context* runningContext();
// The current site of interpreted code, for a signal handler; RUNG_NONE: unknown.
uint32_t currentSite(const rung_context* ctx, const void* details);

// Handles the signals from now on; an application calls it once. The tool has its own handler, which calls raiseCrash.
void catchCrashes();

}  // namespace rung::host
