// SPDX-License-Identifier: Apache-2.0
// The scheduler of networks: LD, FBD and CFC become ordinary statements. Contacts and operators become expressions,
// boxes calls, and a wire that is read more than once a temporary without type, which sema types. In: the elements of a
// body and the signatures of names. Out: its statements. Called by sema when it is about to check the body;
// declareNetworks when it collects the POU.
//
// Order (IEC 61131-3 ed. 3, 8.1.5; TM/TP manual 5.3): elements with an execution order number run in that order. All
// others run network by network, from top to bottom where the file has positions, else in file order; within a network,
// everything connected to an input of a coil, a variable or a box runs before it. A value fed back to an earlier box is
// its value of the last cycle.
#pragma once

#include <vector>

#include "frontend/schedule/edge_coils.h"
#include "frontend/schedule/network_variables.h"
#include "frontend/schedule/scheduled_body.h"
#include "frontend/source/diagnostics.h"
#include "frontend/syntax/signatures.h"
#include "frontend/syntax/tree.h"

namespace rung::diagram {

ScheduledBody scheduleNetworks(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                               const NetworkVariables& variables, EdgeCoils edge_coils, const PouDecl& pou);

// The elements of a body, by their index, in the order in which they run: boxes, composers and selectors, variables
// that are written, coils, jumps, labels, returns. Empty: the wires are wrong, which was reported. Pictures show it.
std::vector<uint32_t> executionOrder(Tree& tree, Names& names, Diagnostics& diagnostics, const Diagram& diagram);

// The hidden variables of a body of networks, as a section of `kind`: instances that detect edges, instances of blocks
// without a name, composed structures, values of functions that are fed back. None: none needed. `variables` tells
// later which is whose. `prefix`: of their names, where the body is an action and they are declared with its owner.
DeclId declareNetworks(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                       NetworkVariables& variables, const PouDecl& pou, SectionKind kind, std::string_view prefix);

}  // namespace rung::diagram
