// Forbids calls outside tests of what only a test may call; see test_only.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkTestOnly(Context& context, const CallExpr& node, PouId callee);

}  // namespace rung::sema
