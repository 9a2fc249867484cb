// SPDX-License-Identifier: Apache-2.0
// The scheduler of Instruction List: instructions become ordinary statements, the accumulator expressions in them. In:
// the instructions of a body and the signatures of names. Out: statements, and temporaries without type where the
// accumulator is read again after another statement, or where paths meet at a label. Called by sema when the
// declarations of all files are known and it is about to check the body.
#pragma once

#include "frontend/schedule/scheduled_body.h"
#include "frontend/source/diagnostics.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/signatures.h"
#include "frontend/syntax/tree.h"

namespace rung::text {

// `short_circuit`: AND and OR of the dialect may skip calls in their right operand; those of IL must always run.
ScheduledBody scheduleIl(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                         Slice<IlInstruction> instructions, bool short_circuit);

}  // namespace rung::text
