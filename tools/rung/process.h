// Child processes: the C++ compiler, the linker, ar. In: argument lists. Out: exit codes and their output.
// At most `jobs` run at a time. Called by native.cpp.
#pragma once

#include <string>
#include <vector>

namespace rung::tool {

struct Process {
  std::vector<std::string> arguments;  // [0] is looked up in PATH
  std::string folder;                  // working folder; empty: the current one
  std::string log;                     // file that gets stdout and stderr
  int exit_code = -1;                  // after runAll: the exit code, 128 + signal, or 127 when it did not start
};

// Runs all; starts no new ones after the first failure. A terminal shows "[done/all] label" after a second. Returns the
// first that failed, or null.
const Process* runAll(std::vector<Process>& processes, unsigned jobs, const char* label);

unsigned processorCount();

}  // namespace rung::tool
