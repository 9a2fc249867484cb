// SPDX-License-Identifier: Apache-2.0
// Follows values of a running program: as a live table on a terminal, or as rows of CSV like those of `rung run
// --trace`. Ends on Ctrl-C, at a limit, or with the program. Called by monitor.cpp.
#pragma once

#include <cstdint>
#include <string>

#include "tools/driver/sink.h"
#include "tools/monitor/client.h"

namespace rung::monitor {

struct Recording {
  std::string paths;      // with commas
  std::string file;       // `-`: stdout
  uint32_t rate = 10;     // events a second
  int64_t for_ns = -1;    // -1: no limit
  int64_t rows = -1;      // the same
  bool is_table = false;  // instead of CSV
};

// Returns the exit code.
int record(Client& client, const Recording& recording, driver::Sink& sink);

}  // namespace rung::monitor
