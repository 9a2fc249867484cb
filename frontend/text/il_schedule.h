// The scheduler of Instruction List: instructions become ordinary statements, the accumulator expressions in them.
// In: the instructions of a body and what the signatures of names tell. Out: statements, and temporaries without type
// where the accumulator is read again after something else ran, or where ways meet at a label (design §3). Called by
// sema when the declarations of all files are known and the body is about to be checked.
#pragma once

#include "frontend/source/diagnostics.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/signatures.h"
#include "frontend/syntax/tree.h"

namespace rung::text {

struct IlStatements {
  Slice<StmtId> body;
  DeclId temporaries;  // a section of variables without type; none: there are none
};

// `short_circuit`: AND and OR of the dialect leave calls in their right operand out; those of IL run all the same.
IlStatements scheduleIl(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                        Slice<IlInstruction> instructions, bool short_circuit);

}  // namespace rung::text
