// SPDX-License-Identifier: Apache-2.0
// Forbids jumps to undeclared or unreachable labels; see jump_labels.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkJumpLabels(Context& context);

}  // namespace rung::sema
