// SPDX-License-Identifier: Apache-2.0
// Forbids calls that leave required pins open; see required_pins.cpp.
#pragma once

#include "sema/bodies/calls.h"
#include "sema/context.h"

namespace rung::sema {

// False after an error.
bool checkRequiredPins(Context& context, const CallExpr& node, PouId pou, const Arguments& arguments);

}  // namespace rung::sema
