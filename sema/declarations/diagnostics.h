// SPDX-License-Identifier: Apache-2.0
// Diagnostics of declarations, configurations and initial values, one constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "sema/declarations/diagnostics.def"
}  // namespace rung::diag
