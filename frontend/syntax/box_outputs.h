// SPDX-License-Identifier: Apache-2.0
// Outputs of boxes that wires name but the file does not list: the result of a function, ENO. Pictures draw a pin for
// each, and the export lists them. In: the elements of a body. Out: their names by element; no name: the result of a
// function, or the first output of a block. Called by frontend/render and frontend/export.
#pragma once

#include <span>
#include <vector>

#include "frontend/syntax/diagram.h"
#include "frontend/syntax/tree.h"

namespace rung {

inline bool isBox(ElementKind kind) {
  return kind == ElementKind::Box || kind == ElementKind::Execute || kind == ElementKind::Compose ||
         kind == ElementKind::Select;
}

std::vector<std::vector<NameId>> unlistedOutputs(const Tree& tree, const Names& names,
                                                 std::span<const DiagramElement> elements);

// The output of that name among those of a box, or their count; a wire without a name begins at the first but ENO.
size_t outputOf(const Names& names, std::span<const NameId> outputs, NameId wire);

}  // namespace rung
