// SPDX-License-Identifier: Apache-2.0
// Diagnostics shared by declarations, checks and bodies, one constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "sema/diagnostics.def"
}  // namespace rung::diag
