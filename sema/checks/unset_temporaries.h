// SPDX-License-Identifier: Apache-2.0
// Warns of temporary variables that are read before they are set; see unset_temporaries.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkUnsetTemporaries(Context& context);

}  // namespace rung::sema
