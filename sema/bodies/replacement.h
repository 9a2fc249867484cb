// SPDX-License-Identifier: Apache-2.0
// Another body in the place of one that was checked. In: POUs of a checked project. Out: a project that knows nothing
// of their bodies, as before ensureBody(). Called for editors, at each key.
#pragma once

#include <span>

#include "sema/context.h"

namespace rung::sema {

// Whether the body is in ST, and neither declarations nor other bodies depend on it.
bool isReplaceable(Context& context, PouId pou);

// Takes back what these bodies said and noted.
void takeBackBodies(Context& context, std::span<const PouId> pous);

}  // namespace rung::sema
