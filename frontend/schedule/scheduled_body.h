// SPDX-License-Identifier: Apache-2.0
// The result of scheduling a body in IL, SFC or networks: a fragment of the tree of its own. Called by sema, which
// checks it.
#pragma once

#include <span>

#include "frontend/syntax/tree_builder.h"

namespace rung {

struct ScheduledBody {
  Slice<StmtId> body;
  DeclId temporaries;  // a section of variables without type; none: no temporaries
};

inline ScheduledBody scheduledBody(Tree& tree, std::span<const StmtId> statements,
                                   std::span<const DeclId> temporaries) {
  ScheduledBody result{tree.addList<StmtId>(statements), {}};
  if (!temporaries.empty())
    result.temporaries = TreeBuilder(tree).section(SectionKind::Temp, temporaries, tree.loc(temporaries.front()));
  return result;
}

}  // namespace rung
