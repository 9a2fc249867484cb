// Privatization: a variable that each turn of a loop gives a new value, works on in an inner loop, and stores at last,
//   for j: 1 to 4 { acc = 0.0  for k: 1 to 4 { acc = add acc, … }  c[i, j] = acc }
// becomes a temporary of the turn. After the loop it gets what the last turn stored: `acc = c[i, 4]`. So no value goes
// from turn to turn or leaves the loop, and g++ works on several turns at once: a product of matrices a third faster.
//   needs  verified IR, checks removed: a fault in the loop would show the variable
//   keeps  what every variable holds behind the loop; loops that call, are left early, may fault or reach memory
//   through
//          references, pointers or globals; loops whose bounds are no constants
//   gives  a temporary more, an assignment behind the loop
//   cost   one walk over the statements; the loops that qualify are walked twice more
#pragma once

#include "ir/ir.h"

namespace rung::ir {

bool privatize(Module& module, Body& body);  // true when something changed

}  // namespace rung::ir
