// SPDX-License-Identifier: Apache-2.0
// Warns of tasks that do not fit the blocks that they run; see task_needs.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkTaskNeeds(Context& context);

}  // namespace rung::sema
