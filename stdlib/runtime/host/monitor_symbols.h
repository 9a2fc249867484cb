// SPDX-License-Identifier: Apache-2.0
// The list of a program's variables for clients of the monitor, a page at a time. In: the symbol tables, and which
// variables are forced. Out: JSON. Called by monitor_requests.cpp in the thread of the server.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "symbols.h"

namespace rung::host {

struct SymbolPage {
  std::string prefix;  // of the paths, in upper or lower case
  uint64_t from = 0, count = 1000;
};
// {"total", "symbols": [{"path", "type", "kind", "writable", "forced"}]}: elementary variables, and before those of a
// record or array the record or array. Without what a program does not offer to tools outside.
std::string listSymbols(const LoadedModule& module, const SymbolPage& page, std::vector<Variable> forced);

// Whether tools outside may write it.
bool isWritableOutside(const rung_variable& variable);

}  // namespace rung::host
