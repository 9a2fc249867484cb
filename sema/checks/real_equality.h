// SPDX-License-Identifier: Apache-2.0
// Warns of REAL values compared for equality; see real_equality.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkRealEquality(Context& context, const BinaryExpr& node);

}  // namespace rung::sema
