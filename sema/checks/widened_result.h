// SPDX-License-Identifier: Apache-2.0
// Warns of a sum or product that is widened after it was calculated; see widened_result.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkWidenedResult(Context& context, ExprId value, TypeId to);

}  // namespace rung::sema
