// See object_members.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkObjectMembers(Context& context, PouId object);

// The type of a variable: no instance of it may be abstract.
bool checkNotAbstract(Context& context, TypeId type, Loc loc);

}  // namespace rung::sema
