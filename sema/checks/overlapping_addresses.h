// SPDX-License-Identifier: Apache-2.0
// Warns of located variables that overwrite parts of each other; see overlapping_addresses.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkOverlappingAddresses(Context& context);

}  // namespace rung::sema
