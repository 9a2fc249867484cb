// SPDX-License-Identifier: Apache-2.0
// Propagation: a read of a temporary or variable of the call that holds a known constant becomes the constant; one
// that holds a copy of another local becomes that local.
//   needs  verified IR; feeds folding, branches and dead code
//   keeps  locals whose address is taken, bound or that are by reference; bodies with labels as they are
//   gives  no read of a scalar local directly after an assignment of a constant to it
//   cost   one walk, each loop's body scanned once more per nesting depth; three arrays over the locals; nothing for a
//          body in which no local gets a constant or a copy
#pragma once

#include "ir/ir.h"

namespace rung::ir {

bool propagate(Module& module, Body& body);  // true when something changed

}  // namespace rung::ir
