// SPDX-License-Identifier: Apache-2.0
// Diagnostics of expressions, calls and statements, one constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "sema/bodies/diagnostics.def"
}  // namespace rung::diag
