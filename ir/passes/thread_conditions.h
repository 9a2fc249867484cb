// SPDX-License-Identifier: Apache-2.0
// Conditions: a temporary that holds the result of an AND or OR whose right operand may fault or calls, and so cannot
// be part of an expression, becomes branches if one `if` is its only reader.
//   needs  verified IR
//   keeps  order of evaluation and faults; a temporary that is read elsewhere; bodies with labels as they are
//   gives  `while i < n AND a[i] <> 0` without temporary: what the left operand proves holds where the right one is
//          checked (remove_checks.h)
//   cost   one walk that counts the reads of temporaries and one over the statements; nothing for a body without `if`
//          on a temporary
#pragma once

#include "ir/ir.h"

namespace rung::ir {

bool threadConditions(Module& module, Body& body);  // true when something changed

}  // namespace rung::ir
