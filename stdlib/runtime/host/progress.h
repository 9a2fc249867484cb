// SPDX-License-Identifier: Apache-2.0
// The progress of a long run in virtual time on a terminal: from its third second on, one line on standard error that
// is rewritten twice a second and cleared before anything else is printed there. Called by run.cpp after each cycle.
#pragma once

#include <cstdint>
#include <cstdio>

namespace rung::host {

class Progress {
 public:
  // Shows nothing when `out` is not a terminal.
  Progress(std::FILE* out, int64_t cycles);
  void show(int64_t cycle) {
    if (next_ns_ != INT64_MAX) showOnTerminal(cycle);
  }
  void clear();

 private:
  void showOnTerminal(int64_t cycle);

  std::FILE* out_;
  int64_t cycles_;
  int64_t next_ns_;
  bool is_shown_ = false;
};

}  // namespace rung::host
