// SPDX-License-Identifier: Apache-2.0
// `rung monitor URL COMMAND …`: reads, writes, forces and follows variables of a running program, and gives it
// commands, by its monitor. In: the words of the command line. Out: what the program answers. Called by
// tools/rung/main.cpp.
#pragma once

#include <string>
#include <vector>

#include "tools/driver/options.h"
#include "tools/driver/sink.h"

namespace rung::monitor {

// The words begin with the URL. `run` has the limits of `watch` and `trace`: --for and --cycles. Returns the exit code.
int runMonitor(const std::vector<std::string>& words, uint32_t rate, const driver::RunOptions& run, driver::Sink& sink);

}  // namespace rung::monitor
