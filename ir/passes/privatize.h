// SPDX-License-Identifier: Apache-2.0
// Privatization: a variable that each iteration of a loop sets, updates in an inner loop and stores at the end,
//   for j: 1 to 4 { acc = 0.0  for k: 1 to 4 { acc = add acc, … }  c[i, j] = acc }
// becomes a temporary of the iteration. After the loop it gets what the last iteration stored: `acc = c[i, 4]`. So no
// value is carried between iterations or out of the loop, and g++ overlaps iterations: a matrix product a third faster.
//   needs  verified IR, checks removed: a fault in the loop would show the variable
//   keeps  what every variable holds after the loop; loops that call, are left early, may fault, have bounds that are
//          not constant, or reach memory through references, pointers or globals
//   gives  one more temporary, one assignment after the loop
//   cost   one walk over the statements; loops that qualify are walked twice more
#pragma once

#include "ir/ir.h"

namespace rung::ir {

bool privatize(Module& module, Body& body);  // true when something changed

}  // namespace rung::ir
