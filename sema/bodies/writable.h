// SPDX-License-Identifier: Apache-2.0
// Forbids writing to anything but a variable that is writable here; see writable.cpp.
#pragma once

#include "sema/bodies/conversions.h"
#include "sema/context.h"

namespace rung::sema {

// False after an error. `expr` was checked with Access::Write or ReadWrite.
bool checkWritable(Context& context, ExprId expr, const Purpose& purpose);

}  // namespace rung::sema
