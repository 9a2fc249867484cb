// Runs one function by the interpreter, in bounds: constant functions, and the `run:` lines of IR tests. In: a verified
// module, a function, values for its inputs and in-outs. Out: its result or its fault, or why it gives none.
#pragma once

#include <span>
#include <string>

#include "ir/interpreter/code.h"
#include "ir/ir.h"

namespace rung::ir::interpreter {

struct FunctionResult {
  types::Fault fault = types::Fault::None;
  types::Value value;   // scalar or text
  std::string trouble;  // no result: endless, too deep, or a native function that is not at hand
};
// Loops turn and calls nest at most `budget` times in all. Inputs are scalars and texts; parameters of other types are
// zero. `names` takes a text that comes out.
FunctionResult runFunction(const Module& module, BodyId function, std::span<const types::Value> arguments,
                           std::span<const Native> natives, int64_t budget, Names& names);

}  // namespace rung::ir::interpreter
