// SPDX-License-Identifier: Apache-2.0
// How the pins of a box are bound to those of what it calls. Used by the scheduler, and for pictures by sema.
#pragma once

#include <vector>

#include "frontend/schedule/network_variables.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/signatures.h"
#include "frontend/syntax/standard_names.h"
#include "frontend/syntax/tree.h"

namespace rung::diagram {

// EN or ENO.
inline bool isControl(const Names& names, NameId pin) { return rung::isControl(names.string(pin)); }
// The POU that a box calls; not one of an operator. `hidden` is its instance if it has none of its own.
Signature signatureOf(Signatures& signatures, const DiagramElement& e, NameId hidden);
// Extensible pins are named IN3, IN4, …
bool hasPin(const Names& names, const Signature& signature, const Ident& pin);
// Some editors use names of their own for all pins of a function: then the order of its pins counts.
bool bindsByName(const Tree& tree, const Names& names, const DiagramElement& e, const Signature& signature);

// Marks the pins of boxes in `diagram` that are in-outs of what they call, by their index in the tree.
void markInOuts(const Tree& tree, const Names& names, Signatures& signatures, const NetworkVariables& variables,
                const Diagram& diagram, std::vector<bool>& in_outs);

}  // namespace rung::diagram
