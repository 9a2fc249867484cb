// SPDX-License-Identifier: Apache-2.0
// The calls of a cycle: see call_trace.h.
#include "call_trace.h"

#include "faults.h"
#include "symbols.h"

namespace rung::host {

void CallTrace::called(const char* pou, const void* instance) {
  const auto [at, is_new] = index_.try_emplace({instance, pou}, calls_.size());
  if (is_new) calls_.push_back({nameOf(pou, instance), 0});
  ++calls_[at->second].count;
}

std::string CallTrace::line(int64_t cycle) {
  std::string out = "cycle " + std::to_string(cycle) + ':';
  const char* separator = " ";
  for (const Call& call : calls_) {
    out += separator + call.name;
    if (call.count > 1) out += " x" + std::to_string(call.count);
    separator = ", ";
  }
  calls_.clear();
  index_.clear();
  return out + '\n';
}

// An instance in a variable of a function has no path: only its type is printed.
std::string CallTrace::nameOf(const char* pou, const void* instance) const {
  const std::string path = instance == nullptr ? std::string() : instancePath(memory_.common(), pou, instance);
  if (path.empty()) return pou;
  return lowerCase(path) == lowerCase(pou) ? path : path + " (" + pou + ')';  // the instance of a program
}

}  // namespace rung::host
