// SPDX-License-Identifier: Apache-2.0
// Who calls whom. In: each resolved call. Out: Project::call_edges and Pou::Progress::used. Called wherever a call is
// found, in bodies and in initial values; the rules of sema/checks walk the sorted calls.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// `name`: where the name of the callee is; none: at `loc`.
void noteCall(Context& context, PouId callee, Loc loc, Loc name = {});
// Sorts calls and writes by the POU that has them, each one's in the order of its body. When all bodies are checked.
void sortEffects(Project& project);

}  // namespace rung::sema
