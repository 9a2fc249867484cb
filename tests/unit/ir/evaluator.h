// A small tree-walking evaluator of scalar functions, for the `; run:` lines of pass tests. It knows locals of scalar
// and array-of-scalar type, all control flow but jumps into other lists, faults and calls of functions; no instances,
// globals, texts or pointers. The interpreter of the product is another (ir/interpreter).
#pragma once

#include <string>
#include <vector>

#include "ir/ir.h"

namespace rung::ir {

struct RunResult {
  types::Fault fault = types::Fault::None;
  types::Value value;   // of the result, when there is one
  std::string trouble;  // what the evaluator does not know, or that the run does not end
};
RunResult run(const Module& module, const Body& body, const std::vector<types::Value>& arguments);

}  // namespace rung::ir
