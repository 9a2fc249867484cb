// SPDX-License-Identifier: Apache-2.0
// Warns of an instance that serves two objects; see served_object.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkServedObject(Context& context, const CallExpr& node, const Call& call);

}  // namespace rung::sema
