// SPDX-License-Identifier: Apache-2.0
// `rung debug`: the debugger in a terminal, with commands that users of gdb know, and as a script. In: lines of a
// terminal or a file. Out: where the program is, and values.
#pragma once

#include <string>
#include <vector>

#include "tools/debug/target.h"

namespace rung::debug {

struct TerminalOptions {
  TargetOptions target;
  std::vector<std::string> scripts;   // -x FILE: their commands come first
  std::vector<std::string> commands;  // -c COMMAND: then these
  bool is_batch = false;              // then it ends
};

// Returns the exit code: that of the program where it ended.
int runTerminal(const TerminalOptions& options, driver::Sink& sink);

}  // namespace rung::debug
