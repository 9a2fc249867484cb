// SPDX-License-Identifier: Apache-2.0
// Crashes of rung itself; see crash.h.
#include "tools/rung/crash.h"

#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "frontend/source/invariant.h"
#include "ir/interpreter/program.h"
#include "rung/host.h"
#include "tools/driver/installation.h"
#include "tools/driver/options.h"

namespace rung::tool {
namespace {

const char* const* arguments = nullptr;
int word_count = 0;
volatile sig_atomic_t program_runs = 0, program_checked = 0;
char alternate_stack[64 * 1024];

const char* signalName(int number) {
  switch (number) {
    case SIGSEGV: return "SIGSEGV (access to unmapped memory, or a stack overflow)";
    case SIGBUS: return "SIGBUS (access beyond the end of a mapped file)";
    case SIGFPE: return "SIGFPE (arithmetic)";
    case SIGILL: return "SIGILL (illegal instruction)";
    case SIGABRT: return "SIGABRT";
    default: return "a signal";
  }
}

void put(const char* text) {
  ssize_t ignored = write(2, text, strlen(text));
  (void)ignored;
}

// Only calls that are safe in a signal handler.
void handle(int number, siginfo_t* info, void* details) {
  if (program_runs) host::raiseCrash(number, info, details);  // does not return when the program crashed
  if (program_runs && !program_checked) {
    put("rung: the program crashed with ");
    put(signalName(number));
    put("; run it with the checks div,index,null,cast to see the location\n");
    _exit(driver::kFault);
  }
  put("rung: internal error: ");
  put(signalName(number));
  put(program_runs ? " in generated code" : " in phase ");
  if (!program_runs) {
    put(currentPhase());
    if (currentPhaseSubject()[0] != '\0') {
      put(", at `");
      put(currentPhaseSubject());
      put("`");
    }
  }
  put("\nthis is a bug in rung ");
  put(driver::version());
  put(", not in your program; please report it with the input and this command:\n  rung");
  for (int i = 0; i < word_count; i++) {
    put(" ");
    put(arguments[i]);
  }
  put("\n");
  _exit(driver::kInternal);
}

}  // namespace

void installCrashHandler(const char* const* command_line, int count) {
  arguments = command_line;
  word_count = count;
  stack_t stack = {};
  stack.ss_sp = alternate_stack;
  stack.ss_size = sizeof alternate_stack;
  sigaltstack(&stack, nullptr);
  host::setFindSite(ir::interpreter::Program::siteOfCrash);
  struct sigaction action = {};
  action.sa_sigaction = handle;
  action.sa_flags =
      SA_SIGINFO | SA_ONSTACK | SA_NODEFER;  // faults of the program leave the handler by longjmp, and may occur again
  for (int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(number, &action, nullptr);
}

void setProgramRuns(bool runs, bool checked) {
  program_runs = runs;
  program_checked = checked;
}

void printInternalError(const char* what) {
  fprintf(stderr,
          "rung: internal error: %s\nthis is a bug in rung %s, not in your program; please report it with the input "
          "and this command:\n  rung",
          what, driver::version());
  for (int i = 0; i < word_count; i++) fprintf(stderr, " %s", arguments[i]);
  fputc('\n', stderr);
}

}  // namespace rung::tool
