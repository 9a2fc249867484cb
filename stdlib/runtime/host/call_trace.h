// SPDX-License-Identifier: Apache-2.0
// The POUs that ran in a cycle, as `rung run --trace-calls` prints them. In: the calls that an interpreted module
// reports (rung_host::called). Out: `cycle 3: Main, Main.rest (TON) x2, Ramp`: instances by path and type, functions by
// name, in the order of their first call.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "memory.h"

namespace rung::host {

class CallTrace {
 public:
  explicit CallTrace(const Memory& memory) : memory_(memory) {}

  void called(const char* pou, const void* instance);
  // The line for the calls since the previous line.
  std::string line(int64_t cycle);

 private:
  struct Call {
    std::string name;
    uint64_t count;
  };
  std::string nameOf(const char* pou, const void* instance) const;

  const Memory& memory_;
  std::vector<Call> calls_;
  std::map<std::pair<const void*, const char*>, size_t> index_;  // by instance and type; index into calls_
};

}  // namespace rung::host
