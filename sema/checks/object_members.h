// SPDX-License-Identifier: Apache-2.0
// Forbids incomplete and conflicting members of objects; see object_members.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkObjectMembers(Context& context, PouId object);

// Forbids an abstract type for a variable or its parts.
bool checkNotAbstract(Context& context, TypeId type, Loc loc);

}  // namespace rung::sema
