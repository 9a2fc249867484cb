// Forbids jumps to labels that are not there or not in reach; see jump_labels.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkJumpLabels(Context& context);

}  // namespace rung::sema
