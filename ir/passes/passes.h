// All passes in the order in which they run: the list that --dump-after, --time-phases and the verifier read.
// In: a verified module. Out: the same, smaller. -O0 runs none, -O1 what keeps POUs apart, -O2 also across POUs.
#pragma once

#include <span>
#include <string_view>

#include "frontend/source/function_ref.h"
#include "ir/ir.h"

namespace rung::ir {

struct Pass {
  const char* name;
  bool (*run)(Module& module, Body& body);  // true when something changed
};
std::span<const Pass> bodyPasses(int level);

// Runs the passes over every body. After each pass calls `after(pass name, body)`; the debug build verifies there.
void optimize(Module& module, int level, FunctionRef<void(const Pass&, Body&)> after);
void optimize(Module& module, Body& body, int level, FunctionRef<void(const Pass&, Body&)> after);

}  // namespace rung::ir
