// SPDX-License-Identifier: Apache-2.0
// The body of a POU in any language; see body.cpp.
#pragma once

#include <unordered_set>
#include <vector>

#include "sema/context.h"

namespace rung::sema {

void checkBody(Context& context, PouId pou);
// Checks the body of a POU unless that is done. False: it has errors, or is being checked.
bool ensureBody(Context& context, PouId pou);

// The statements of one body.
struct BodyState {
  struct LoopControl {
    VarId var;
    Loc loc;
  };
  struct LabelUse {
    Ident label;
    uint32_t block;
  };
  std::vector<LoopControl> loop_controls;
  uint32_t stmt_depth = 0, elsif_depth = 0;
  uint32_t block = 0;                   // the current statement list
  std::vector<uint32_t> block_parents;  // of each statement list of the body; filled only with labels in use
  std::vector<LabelUse> labels, jumps;
  struct Temporary {  // temporaries.cpp
    VarId var;
    TypeId type = {};                    // none: not known yet
    Loc first = {};                      // the value that gave it
    std::vector<AssignStmt*> open = {};  // literals that wait for the type
    std::vector<AssignStmt*> assigns = {};
    bool busy = false;
  };
  struct Served {  // checks/served_object.cpp: what an in-out of an instance was bound to first
    VarId instance, pin, object;
  };
  std::vector<Served> served;
  std::unordered_set<const AssignStmt*> with_value;  // assignments to temporaries whose value has a type
  std::vector<Temporary> temporaries;                // all declared before the first statement is checked
  Slice<StmtId> statements;
  bool assigns_known = false;
  uint32_t looking_ahead = 0;
  uint32_t ways_out = 0;  // EXIT, RETURN and JMP seen so far: a loop without one between its ends never ends
};

}  // namespace rung::sema
