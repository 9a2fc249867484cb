// What happens when rung itself breaks: signals end in exit code 70 with phase, POU and what to report, never in a core
// dump without a word. Called by main.cpp once; native.cpp reports what g++ refused in the same words.
#pragma once

namespace rung::tool {

void installCrashHandler(const char* const* arguments, int count);

// While code of the user's program runs, a crash is the program's: exit code 3, unless all checks are on.
void setProgramRuns(bool runs, bool checked);

// "rung: internal error: WHAT" and what to send; the caller exits with 70.
void printInternalError(const char* what);

}  // namespace rung::tool
