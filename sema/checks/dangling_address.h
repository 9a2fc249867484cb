// SPDX-License-Identifier: Apache-2.0
// Warns of an address that outlives its variable; see dangling_address.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkDanglingAddress(Context& context, ExprId target, ExprId value);

}  // namespace rung::sema
