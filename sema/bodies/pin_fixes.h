// SPDX-License-Identifier: Apache-2.0
// The fix of a call that leaves a pin open. In: the call and the pin. Out: one more argument, and where no variable has
// the name of the pin, its declaration. Called by the checks of calls.
#pragma once

#include "sema/fixes.h"

namespace rung::sema {

// A variable of the pin's name.
Fix boundPin(Context& context, const CallExpr& call, const Var& pin);
// In a call without names: values for the inputs from one on.
Fix withValues(Context& context, const CallExpr& call, PouId pou, VarId from);

}  // namespace rung::sema
