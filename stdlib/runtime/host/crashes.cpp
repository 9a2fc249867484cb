// SPDX-License-Identifier: Apache-2.0
// Signals of the program as faults: see crashes.h.
#include "crashes.h"

#include <ucontext.h>
#include <csignal>
#include <cstdint>
#include <cstdlib>

#include "rung/code.h"

namespace rung::host {
namespace {

thread_local rung_context* context_of_thread = nullptr;
FindSite find_site = nullptr;
constexpr size_t kStackBytes = size_t{64} << 10;
constexpr uintptr_t kNearStack = uintptr_t{64} << 10;

// A stack for the handler, which still works when that of the thread is used up.
struct AlternateStack {
  AlternateStack() {
    stack_t now{};
    if (sigaltstack(nullptr, &now) != 0 || (now.ss_flags & SS_DISABLE) == 0) return;
    memory = std::malloc(kStackBytes);
    if (memory == nullptr) return;
    stack_t own{};
    own.ss_sp = memory;
    own.ss_size = kStackBytes;
    sigaltstack(&own, nullptr);
  }
  ~AlternateStack() {
    if (memory == nullptr) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
    std::free(memory);
  }
  void* memory = nullptr;
};

uintptr_t stackPointer(const void* details) {
#if defined(__x86_64__)
  return static_cast<uintptr_t>(static_cast<const ucontext_t*>(details)->uc_mcontext.gregs[REG_RSP]);
#elif defined(__aarch64__)
  return static_cast<uintptr_t>(static_cast<const ucontext_t*>(details)->uc_mcontext.sp);
#else
  return 0;
#endif
}

void handle(int number, siginfo_t* info, void* details) {
  raiseCrash(number, info, details);
  signal(number, SIG_DFL);
  raise(number);
}

}  // namespace

uint8_t guarded(rung_context* ctx, void (*run)(rung_context*)) {
  thread_local const AlternateStack stack;
  static_cast<void>(stack.memory);
  rung_context* const outer = context_of_thread;
  context_of_thread = ctx;
  const uint8_t kind = rung_guarded(ctx, run);
  context_of_thread = outer;
  return kind;
}

rung_context* runningContext() { return context_of_thread; }

uint32_t currentSite(const rung_context* ctx, const void* details) {
  return find_site == nullptr ? RUNG_NONE : find_site(ctx, details);
}

void catchCrashes() {
  struct sigaction action {};
  action.sa_sigaction = handle;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;  // the handler may be left by longjmp, and must run again
  for (const int number : {SIGSEGV, SIGBUS}) sigaction(number, &action, nullptr);
}

void raiseCrash(int number, const siginfo_t* info, const void* details) {
  if ((number != SIGSEGV && number != SIGBUS) || context_of_thread == nullptr) return;
  const uintptr_t address = reinterpret_cast<uintptr_t>(info->si_addr), stack = stackPointer(details);
  const bool is_stack = address - (stack - kNearStack) < 2 * kNearStack;
  rung_raise_crash(context_of_thread, is_stack ? RUNG_FAULT_STACK : RUNG_FAULT_NULL,
                   currentSite(context_of_thread, details), is_stack ? 0 : RUNG_BAD_ADDRESS);
}

void setFindSite(FindSite find) { find_site = find; }

}  // namespace rung::host
