// Warns of variables that nobody reads or writes; see unused_variables.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkUnusedVariables(Context& context);

}  // namespace rung::sema
