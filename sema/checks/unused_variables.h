// SPDX-License-Identifier: Apache-2.0
// Warns of variables that are never read or written; see unused_variables.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkUnusedVariables(Context& context);

}  // namespace rung::sema
