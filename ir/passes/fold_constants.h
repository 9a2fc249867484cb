// SPDX-License-Identifier: Apache-2.0
// Constant folding: operators, conversions and selects of constants become constants; identities that are exact in IEC
// semantics (x + 0, x AND FALSE, NOT NOT x) become their operand; checks that a constant proves are removed.
//   needs  verified IR
//   keeps  faults: a node that faults is never folded, an operand that may fault is never dropped
//   gives  no div check with a constant divisor other than 0, no index check with constant indices inside the bounds
//   cost   one pass over the expression pool, operands before users as the builder makes them; no allocation
#pragma once

#include "ir/ir.h"

namespace rung::ir {

bool foldConstants(Module& module, Body& body);  // true when something changed

}  // namespace rung::ir
