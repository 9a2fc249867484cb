// Forbids outside of tests what only tests may use; see test_only.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

void checkTestOnly(Context& context, PouId used, Loc loc);

}  // namespace rung::sema
