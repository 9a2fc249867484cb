// SPDX-License-Identifier: Apache-2.0
// Warns of = and <> between an elapsed time and another time; see time_equality.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkTimeEquality(Context& context, const BinaryExpr& node);

}  // namespace rung::sema
