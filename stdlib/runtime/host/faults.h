// SPDX-License-Identifier: Apache-2.0
// Formats what a program reports, `path:line: fault[div]: division by zero in Main`, and finds instances by their
// addresses.
#pragma once

#include <string>
#include <string_view>

#include "rung/host.h"

namespace rung::host {

struct Ending;

// `what`, and which body in C++ runs.
std::string describeCppBody(const rung_context& context, const ShownPaths& paths, const std::string& what);

// `context`: of the activation that faulted. As long as it has the callers of this fault, they follow, a line each.
std::string describeFault(const rung_context& context, const rung_fault& fault, const ShownPaths& paths);

// Why an activation did not complete. `context`: where the ending has none of its own.
std::string describeEnding(const Ending& ending, const rung_context& context, const ShownPaths& paths);

// `assertion failed: expected 1, got 2 (why)`.
std::string describeAssertion(const rung_assertion& assertion, const char* expected, const char* actual);

// A message of the program to its operator: `12.500 s: warning: the door is open`.
std::string messageLine(int64_t now_ns, uint8_t severity, const char* text);
const char* severityWord(uint8_t severity);

// The path of the instance of this type at an address; '': there is none, such as for a variable of a function.
std::string instancePath(const rung_context& context, std::string_view type, const void* instance);

}  // namespace rung::host
