// SPDX-License-Identifier: Apache-2.0
// Forbids copies of {no_copy} blocks; see uncopied.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// The {no_copy} block that a variable of this type holds; none: it may be copied.
PouId uncopiedIn(Context& context, TypeId type);

// False after an error.
bool checkKept(Context& context, const Var& var, Loc loc);
bool checkCopied(Context& context, ExprId expr, TypeId type);

}  // namespace rung::sema
