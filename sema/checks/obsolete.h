// SPDX-License-Identifier: Apache-2.0
// A warning at each use of a POU or type that is marked obsolete. In: the declaration that a name means. Called for
// every call and every type name.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void checkObsolete(Context& context, const DeclHeader& declared, NameId name, Loc loc);

}  // namespace rung::sema
