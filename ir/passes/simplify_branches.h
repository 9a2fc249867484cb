// SPDX-License-Identifier: Apache-2.0
// Branch and CASE simplification: an `if` or `switch` on a constant keeps only the branch that it takes; branches
// without statements and unreachable statements are removed.
//   needs  verified IR; finds more after folding
//   keeps  order of calls and faults, labels still jumped to, locations
//   gives  no constant selector; nothing between a `return`, `break`, `continue`, `jump` or `fault` and the next
//          label; no empty `then`; no label without jump
//   cost   one walk over the statements; allocation only for the labels of bodies that have some
#pragma once

#include "ir/ir.h"

namespace rung::ir {

bool simplifyBranches(Module& module, Body& body);  // true when something changed

}  // namespace rung::ir
