// SPDX-License-Identifier: Apache-2.0
// Temporaries of the compiler: variables without declared type that the schedulers of IL and diagrams use. Such a
// variable has the type of the values assigned to it, which they share. Literals adapt to that type or, if there are
// only literals, to the type that the first reader wants.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// Adds the variables of a scheduler's section to the current POU.
void declareTemporaries(Context& context, DeclId section);
// `temporary := value`. False: the target is something else.
bool checkTemporaryAssign(Context& context, AssignStmt& node);
// True for a name whose type its reader may still choose.
bool isOpenTemporary(Context& context, ExprId expr);
// The type of a temporary that is read.
TypeId temporaryType(Context& context, VarId id, TypeId expected);
// Types the temporaries that are never read. Called at the end of the body.
void finalizeTemporaries(Context& context);

}  // namespace rung::sema
