// SPDX-License-Identifier: Apache-2.0
// Ends activations that do not end by themselves: after a time limit, and on SIGINT. A signal sets rung_context::stop,
// which code asks for at loops and calls (rung_poll). In: the context of the activations, one thread. Out:
// RUNG_FAULT_STOP. Called by run.cpp and test.cpp; a process has one Stopper at a time.
#pragma once

#include <cstdint>

#include "rung/module.h"

namespace rung::host {

class Stopper {
 public:
  // Called in a signal handler when the code has not ended a second after it was asked to, or on a second SIGINT.
  using Hung = void (*)(const rung_context* context, uint8_t reason);
  // SIGINT ends the activation at once, or when 200 ms later it has not ended by itself. The caller then looks at
  // `reason` between two cycles.
  enum class Interrupt : uint8_t { AtOnce, AfterTheCycle };

  Stopper(rung_context& context, Hung hung, Interrupt interrupt = Interrupt::AtOnce);
  ~Stopper();  // the signals mean what they meant before
  Stopper(const Stopper&) = delete;
  Stopper& operator=(const Stopper&) = delete;

  // SIGTERM does the same as SIGINT.
  void alsoOnTermination();
  // Another version of the program takes over: its context is the one to stop.
  static void moveTo(rung_context& context);
  // From now on; 0: none.
  void limitTime(int64_t ns);
  uint8_t reason() const;  // a rung_stop
  // The fault of an activation between two polls, or of none: its site where the signal came.
  rung_fault fault() const;
};

}  // namespace rung::host
