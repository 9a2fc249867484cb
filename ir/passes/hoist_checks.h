// SPDX-License-Identifier: Apache-2.0
// Hoisting: a check that gives the same answer in every iteration of a loop, and that the first iteration reaches
// before it changes anything that others see, is done once, in front of the loop:
//   for k: 1 to n { x = add x, ptr^![k] }   becomes   if le 1, n { evaluate ptr^! }  for k: 1 to n { x = add x, ptr^[k]
//   }
// The control variable gets its first value before, so that a fault shows the same values as without the pass.
//   needs  verified IR, checks removed: what is left cannot be proved
//   keeps  which fault comes first, and all values at that time; loops with labels, and bounds that may fault or that
//          depend on the control variable
//   gives  loops without null checks of pointers and in-outs, and without checks of indices that do not change; of
//          `a[k, i]!` in a loop over i, the check of k
//   cost   one walk over the statements, each loop's body scanned once more per nesting depth
#pragma once

#include "ir/exposure.h"
#include "ir/ir.h"

namespace rung::ir {

bool hoistChecks(Module& module, const Exposure& exposure, Body& body);  // true when something changed

}  // namespace rung::ir
