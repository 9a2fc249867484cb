// SPDX-License-Identifier: Apache-2.0
// A small tree-walking evaluator of scalar functions, for the `; run:` lines of pass tests. It supports locals of
// scalar and array-of-scalar type, all control flow except jumps into other lists, faults and calls of functions; no
// instances, globals, strings or pointers. Independent of the product's interpreter (ir/interpreter).
#pragma once

#include <string>
#include <vector>

#include "ir/ir.h"

namespace rung::ir {

struct RunResult {
  types::Fault fault = types::Fault::None;
  types::Value value;   // of the result, when there is one
  std::string trouble;  // an unsupported construct, or that the run does not end
};
RunResult run(const Module& module, const Body& body, const std::vector<types::Value>& arguments);

}  // namespace rung::ir
