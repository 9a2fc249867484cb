// SPDX-License-Identifier: Apache-2.0
// Runs one function with a budget: constant functions, and the `run:` lines of IR tests. In: a verified module, a
// function, values for its inputs and in-outs. Out: its result or its fault, or the reason why it has none.
#pragma once

#include <span>
#include <string>

#include "ir/interpreter/code.h"
#include "ir/ir.h"

namespace rung::ir::interpreter {

struct FunctionResult {
  types::Fault fault = types::Fault::None;
  types::Value value;   // scalar or string
  std::string trouble;  // no result: endless, too deep, or a native function that is not available
};
// Loop iterations and calls use up at most `budget` in all. Inputs are scalars and strings; parameters of other types
// are zero. `names` interns a string result.
FunctionResult runFunction(const Module& module, BodyId function, std::span<const types::Value> arguments,
                           std::span<const Native> natives, int64_t budget, Names& names);

}  // namespace rung::ir::interpreter
