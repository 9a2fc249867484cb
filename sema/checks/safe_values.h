// SPDX-License-Identifier: Apache-2.0
// What a function marked {safe_values} may write; see safe_values.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void checkSafeValues(Context& context);

}  // namespace rung::sema
