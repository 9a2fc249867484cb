// SPDX-License-Identifier: Apache-2.0
// Constant functions: a call with constant inputs, run while the program is checked, where the standard wants constants
// (bounds, CASE labels, initial values of constants). In: the function and the values of its inputs; `ready` checks
// each body on request. Out: its result; none when it reads or writes anything but its own variables, faults, or
// exceeds the budget. The tool passes it to sema as a callback (sema::Options::call_constant), so sema includes no
// later layer.
#pragma once

#include <optional>
#include <span>

#include "ir/interpreter/code.h"
#include "sema/project.h"

namespace rung::ir::interpreter {

std::optional<types::Value> callConstant(sema::Project& project, sema::PouId function,
                                         std::span<const types::Value> values, std::span<const Native> natives,
                                         FunctionRef<bool(sema::PouId)> ready);

}  // namespace rung::ir::interpreter
