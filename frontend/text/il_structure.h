// Jumps of Instruction List as IF and ELSE, where they lead forward over statements that no other way enters: what is
// left has no labels, is read more easily, and is compiled as well as ST. In: the statements that the scheduler made.
// Out: the same with fewer jumps and labels. Called by il_schedule.cpp.
#pragma once

#include <vector>

#include "frontend/source/names.h"
#include "frontend/syntax/tree.h"

namespace rung::text {

void structureJumps(Tree& tree, const Names& names, std::vector<StmtId>& statements);

}  // namespace rung::text
