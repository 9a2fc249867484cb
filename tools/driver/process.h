// SPDX-License-Identifier: Apache-2.0
// Child processes: the C++ compiler, the linker, ar. In: argument lists. Out: exit codes and their output.
// At most `jobs` run at a time. Called by native.cpp.
#pragma once

#include <string>
#include <vector>

#include "tools/driver/sink.h"

namespace rung::driver {

struct Process {
  std::vector<std::string> arguments;  // [0] is looked up in PATH
  std::string folder;                  // working folder; empty: the current one
  std::string log;                     // file that gets stdout and stderr
  int exit_code = -1;                  // after runAll: the exit code, 128 + signal, or 127 when it did not start
};

// Runs all; starts no new ones after the first failure. Returns the first that failed, or null.
const Process* runAll(std::vector<Process>& processes, unsigned jobs, const char* label, Sink& sink);

unsigned processorCount();

}  // namespace rung::driver
