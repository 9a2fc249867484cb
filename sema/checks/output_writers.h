// SPDX-License-Identifier: Apache-2.0
// Warns of outputs that two POUs write; see output_writers.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

void checkOutputWriters(Context& context);

}  // namespace rung::sema
