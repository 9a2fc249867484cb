// SPDX-License-Identifier: Apache-2.0
// Formats faults for the user: `path:line: fault[div]: division by zero in Main`.
#pragma once

#include <string>

#include "rung/host.h"

namespace rung::host {

// `what`, and which body in C++ runs.
std::string describeCppBody(const rung_context& context, const ShownPaths& paths, const std::string& what);

// `context`: of the activation that faulted. As long as it has the callers of this fault, they follow, a line each.
std::string describeFault(const rung_context& context, const rung_fault& fault, const ShownPaths& paths);

}  // namespace rung::host
