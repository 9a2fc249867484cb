// SPDX-License-Identifier: Apache-2.0
// Formats faults for the user, and finds instances by their addresses: `path:line: fault[div]: division by zero in
// Main`.
#pragma once

#include <string>
#include <string_view>

#include "rung/host.h"

namespace rung::host {

// `what`, and which body in C++ runs.
std::string describeCppBody(const rung_context& context, const ShownPaths& paths, const std::string& what);

// `context`: of the activation that faulted. As long as it has the callers of this fault, they follow, a line each.
std::string describeFault(const rung_context& context, const rung_fault& fault, const ShownPaths& paths);

// The path of the instance of a POU (`Belt`, or `Belt.run`) at an address; '': there is none, such as for a variable of
// a function.
std::string instancePath(const rung_context& context, std::string_view pou, const void* instance);

}  // namespace rung::host
