// The scheduler of networks: LD, FBD and CFC become ordinary statements (design §3). Contacts and operators become
// expressions, boxes calls, and a wire that is read more than once a temporary without type, which sema types.
// In: the elements of a body and what the signatures of names tell. Out: its statements. Called by sema when the body
// is about to be checked; the hidden variables are declared when its POU is.
//
// Order (IEC 61131-3 ed. 3, 8.1.5; TM/TP manual 5.3): elements with a turn of their own take it. All others go network
// by network, from top to bottom where the file has places, else in its order; within a network whatever leads to a
// coil, a variable or a box comes before it. What a box gives back to an earlier one is its value of the last cycle.
#pragma once

#include "frontend/source/diagnostics.h"
#include "frontend/syntax/signatures.h"
#include "frontend/syntax/tree.h"

namespace rung::diagram {

struct Statements {
  Slice<StmtId> body;
  DeclId temporaries;  // a section of variables without type; none: there are none
};
Statements scheduleNetworks(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                            const PouDecl& pou);

// The variables that a body of networks needs and nobody wrote, as a section of `kind`: instances that sense edges,
// those of blocks without a name, structures that are composed. None: it needs none. `prefix`: of their names, where
// the body is an action and they join the variables of its owner.
DeclId declareNetworks(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures, const PouDecl& pou,
                       SectionKind kind, std::string_view prefix);

}  // namespace rung::diagram
