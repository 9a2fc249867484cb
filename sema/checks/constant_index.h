// SPDX-License-Identifier: Apache-2.0
// Forbids a constant index outside of the bounds; see constant_index.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

// `dimension`: null for ARRAY[*].
void checkConstantIndex(Context& context, ExprId index, const types::Dimension* dimension, TypeId array);

}  // namespace rung::sema
