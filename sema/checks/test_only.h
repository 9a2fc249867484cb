// SPDX-License-Identifier: Apache-2.0
// Forbids test-only POUs outside of tests; see test_only.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void checkTestOnly(Context& context, PouId used, Loc loc);

}  // namespace rung::sema
