// SPDX-License-Identifier: Apache-2.0
// Terminates a run that violated an invariant: prints the phase, the POU and the invariant, exits with 70.
#include "frontend/source/invariant.h"

#include <cstdio>
#include <cstdlib>

namespace rung {
namespace {

constexpr unsigned long kSubjectBytes = 200;

thread_local const char* phase = nullptr;
thread_local char subject[kSubjectBytes + 1];

}  // namespace

void setPhase(const char* name) {
  phase = name;
  subject[0] = '\0';
}

void setPhaseSubject(const char* name, unsigned long length) {
  const unsigned long n = length < kSubjectBytes ? length : kSubjectBytes;
  for (unsigned long i = 0; i < n; ++i) {
    const bool printable = static_cast<unsigned char>(name[i]) >= 0x20 && name[i] != 0x7f;
    subject[i] = printable ? name[i] : '?';
  }
  subject[n] = '\0';
}

const char* currentPhase() { return phase != nullptr ? phase : "start"; }

const char* currentPhaseSubject() { return subject; }

void invariantFailed(const char* condition, const char* what, const char* file, int line) {
  std::fputs("rung: internal error", stderr);
  if (phase != nullptr) std::fprintf(stderr, " in %s", phase);
  if (subject[0] != '\0') std::fprintf(stderr, " of `%s`", subject);
  std::fprintf(stderr, ": %s\n  %s:%d: %s\n", what, file, line, condition);
  std::fputs("This is a bug in Rung, not in your program. Please report these lines, the command and its input.\n",
             stderr);
  std::fflush(stderr);
  std::_Exit(70);  // no destructors and no flush of half-written output
}

}  // namespace rung
