// SPDX-License-Identifier: Apache-2.0
// Forbids bodies whose calls need more memory than a stack has; see call_memory.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkCallMemory(Context& context);

}  // namespace rung::sema
