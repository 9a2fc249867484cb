// SPDX-License-Identifier: Apache-2.0
// Crashes of rung itself: signals end in exit code 70 and a message with phase, POU and how to report it, never in a
// silent core dump. main.cpp installs the handler once; native.cpp reports generated code that g++ rejects likewise.
#pragma once

namespace rung::tool {

void installCrashHandler(const char* const* arguments, int count);

// While code of the user's program runs, a crash is the program's: exit code 3, unless all checks are on.
void setProgramRuns(bool runs, bool checked);

// Prints "rung: internal error: WHAT" and what to send; the caller exits with 70.
void printInternalError(const char* what);

}  // namespace rung::tool
