// SPDX-License-Identifier: Apache-2.0
// All passes in the order in which they run: the list that --dump-after, --time-phases and the verifier read.
// In: a verified module. Out: the same module, smaller. Each pass sees one body at a time, and what others may reach.
// -O0 runs none, -O1 and -O2 run all of them: -O2 only makes the C++ compiler optimize every body (codegen/effort.h).
#pragma once

#include <span>
#include <string_view>

#include "frontend/source/function_ref.h"
#include "ir/exposure.h"
#include "ir/ir.h"

namespace rung::ir {

struct Pass {
  const char* name;
  bool (*run)(Module& module, const Exposure& exposure, Body& body);  // true when something changed
};
std::span<const Pass> bodyPasses(int level);

// Runs the passes over every body. Calls `after(pass, body)` after each pass; the debug build verifies there.
void optimize(Module& module, int level, FunctionRef<void(const Pass&, Body&)> after);

}  // namespace rung::ir
