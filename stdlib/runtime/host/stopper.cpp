// SPDX-License-Identifier: Apache-2.0
// Time limits and SIGINT: see stopper.h.
#include "stopper.h"

#include <sys/time.h>
#include <csignal>

#include "crashes.h"

namespace rung::host {
namespace {

constexpr int64_t kRepeatNs = 20'000'000;
constexpr int kTicksUntilHung = 50;
constexpr int kTicksForTheCycle = 10;

rung_context* volatile context_to_stop = nullptr;
Stopper::Hung call_when_hung = nullptr;
volatile sig_atomic_t stop_reason = RUNG_STOP_NONE, ticks = 0, ticks_for_the_cycle = 0;
volatile uint32_t stop_site = RUNG_NONE;
struct sigaction old_interrupt, old_alarm, old_termination;
bool has_termination = false;

void setTimer(int64_t first_ns, int64_t next_ns) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(first_ns / 1'000'000'000);
  timer.it_value.tv_usec = static_cast<suseconds_t>(first_ns % 1'000'000'000 / 1000);
  timer.it_interval.tv_sec = static_cast<time_t>(next_ns / 1'000'000'000);
  timer.it_interval.tv_usec = static_cast<suseconds_t>(next_ns % 1'000'000'000 / 1000);
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void onStopSignal(int number, siginfo_t*, void* details) {
  rung_context* const context = context_to_stop;
  if (context == nullptr) return;
  const bool again = stop_reason != RUNG_STOP_NONE;
  if (!again) {
    stop_reason = number == SIGALRM ? RUNG_STOP_TIME : RUNG_STOP_INTERRUPT;
    ticks = 0;
    if (runningContext() == context) stop_site = currentSite(context, details);
    setTimer(kRepeatNs, kRepeatNs);
  }
  if (number == SIGALRM) ticks = ticks + 1;
  if (stop_reason == RUNG_STOP_TIME || ticks >= ticks_for_the_cycle) context->stop = static_cast<uint8_t>(stop_reason);
  if (again && (number != SIGALRM || ticks > kTicksUntilHung))
    call_when_hung(context, static_cast<uint8_t>(stop_reason));
}

void installHandler(int number, struct sigaction* old) {
  struct sigaction action {};
  action.sa_sigaction = onStopSignal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_RESTART;
  sigaction(number, &action, old);
}

}  // namespace

Stopper::Stopper(rung_context& context, Hung hung, Interrupt interrupt) {
  ticks_for_the_cycle = interrupt == Interrupt::AfterTheCycle ? kTicksForTheCycle : 0;
  context_to_stop = &context;
  call_when_hung = hung;
  stop_reason = RUNG_STOP_NONE;
  stop_site = RUNG_NONE;
  context.stop = RUNG_STOP_NONE;
  has_termination = false;
  sigaction(SIGINT, nullptr, &old_interrupt);
  installHandler(SIGALRM, &old_alarm);
  if (old_interrupt.sa_handler != SIG_IGN) installHandler(SIGINT, nullptr);
}

Stopper::~Stopper() {
  setTimer(0, 0);
  sigaction(SIGINT, &old_interrupt, nullptr);
  sigaction(SIGALRM, &old_alarm, nullptr);
  if (has_termination) sigaction(SIGTERM, &old_termination, nullptr);
  context_to_stop->stop = RUNG_STOP_NONE;
  context_to_stop = nullptr;
}

void Stopper::alsoOnTermination() {
  has_termination = true;
  installHandler(SIGTERM, &old_termination);
}

void Stopper::moveTo(rung_context& context) {
  context.stop = context_to_stop->stop;
  context_to_stop = &context;
}

void Stopper::limitTime(int64_t ns) {
  if (stop_reason == RUNG_STOP_INTERRUPT) return;
  setTimer(0, 0);
  stop_reason = RUNG_STOP_NONE;
  stop_site = RUNG_NONE;
  context_to_stop->stop = RUNG_STOP_NONE;
  if (ns > 0) setTimer(ns < 1000 ? 1000 : ns, kRepeatNs);
}

uint8_t Stopper::reason() const { return static_cast<uint8_t>(stop_reason); }

rung_fault Stopper::fault() const { return {RUNG_FAULT_STOP, stop_site, stop_reason}; }

}  // namespace rung::host
