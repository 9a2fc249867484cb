// SPDX-License-Identifier: Apache-2.0
// Dead code: removes assignments to temporaries and variables of the call that nothing reads, evaluations that cannot
// fault, and calls of pure functions whose result is not used.
//   needs  verified IR; finds more after propagation
//   keeps  faults: a value that may fault is still evaluated; order
//   gives  no temporary that is written and never read
//   cost   at most three rounds of one pass over the expressions in use and one walk over the statements
#pragma once

#include "ir/ir.h"

namespace rung::ir {

bool removeDeadCode(Module& module, Body& body);  // true when something changed

}  // namespace rung::ir
