// SPDX-License-Identifier: Apache-2.0
// Checks the control variable, limits and step of FOR; see for_header.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

// The type of the control variable, or Error.
TypeId checkForControl(Context& context, ForStmt& node);
// Checks limits and step, which have the control variable's type.
void checkForBounds(Context& context, const ForStmt& node);

}  // namespace rung::sema
