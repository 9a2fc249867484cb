// SPDX-License-Identifier: Apache-2.0
// RUNG_INVARIANT(cond, "what must hold"): bugs of Rung itself. On in release builds; prints phase, POU and source line,
// asks for a bug report and exits with 70. Never reachable from user input.
#pragma once

namespace rung {

[[noreturn]] void invariantFailed(const char* condition, const char* what, const char* file, int line);

// Named in an internal error: the phase ("lowering") and the POU being processed. Set by the driver and by each phase.
void setPhase(const char* phase);
void setPhaseSubject(const char* name, unsigned long length);
// The phase set last, never null: for the tool's signal handler.
const char* currentPhase();
const char* currentPhaseSubject();

}  // namespace rung

#define RUNG_INVARIANT(cond, what) \
  (__builtin_expect(static_cast<bool>(cond), 1) ? void() : ::rung::invariantFailed(#cond, what, __FILE__, __LINE__))
