// SPDX-License-Identifier: Apache-2.0
// Turns forward jumps of Instruction List into IF and ELSE, where no other path enters the statements in between. A
// body with labels keeps its variables in memory and runs 1.4 times as long as the same ST; most labels are only ever
// jumped to from above. In: the statements made by the scheduler. Out: the same with fewer jumps and labels. Called by
// il_schedule.cpp, before sema sees them.
#pragma once

#include <vector>

#include "frontend/source/names.h"
#include "frontend/syntax/tree.h"

namespace rung::text {

void structureJumps(Tree& tree, const Names& names, std::vector<StmtId>& statements);

}  // namespace rung::text
