// Functions and operators whose value is read before their turn: by wires that lead in a circle, or by elements whose
// turn comes earlier. They keep the value of the last cycle in a variable, whose type must be known when variables are
// declared, long before bodies are checked; what the names and the declarations of the POU tell is enough for that.
// Private to frontend/diagram, called by declare.cpp.
#pragma once

#include "frontend/diagram/graph.h"

namespace rung::diagram {

// The elements that need a variable. What has no type is left to the scheduler, which reports it.
std::vector<uint32_t> readBeforeTurn(const Tree& tree, const Graph& graph);

// The type of what a box gives; none: not known.
TypeExprId typeOfBox(Tree& tree, Names& names, const PouDecl& pou, const Graph& graph, uint32_t box);

}  // namespace rung::diagram
