// SPDX-License-Identifier: Apache-2.0
// Child processes of the tests. In: a command, a folder, a time limit. Out: exit code and output.
// Safe to call from several threads.
#pragma once

#include <string>
#include <vector>

namespace rung::tests {

#ifdef RUNG_SANITIZED
constexpr bool kSanitized = true;  // everything takes about ten times as long
#else
constexpr bool kSanitized = false;
#endif

struct Command {
  std::vector<std::string> arguments;  // [0]: the program, a path
  std::string folder;
  int seconds = 600;    // with sanitizers ten times as many; then it and its children are killed
  bool merged = false;  // stderr goes to stdout
};

struct Output {
  int exit_code = -1;  // 128 + signal; 124: out of time
  std::string out, err;
};

Output run(const Command& command);

// The command as a user types it from the project's root.
std::string commandLine(const Command& command);

}  // namespace rung::tests
