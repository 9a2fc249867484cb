// SPDX-License-Identifier: Apache-2.0
// Warns of instances that are never called; see uncalled_instances.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkUncalledInstances(Context& context);

}  // namespace rung::sema
