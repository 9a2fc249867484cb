// See uncopied.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

// The block marked {no_copy} that a variable of this type holds; none: it may be copied.
PouId uncopiedIn(Context& context, TypeId type);

// False when it was reported.
bool checkKept(Context& context, const Var& var, Loc loc);
bool checkCopied(Context& context, ExprId expr, TypeId type);

}  // namespace rung::sema
