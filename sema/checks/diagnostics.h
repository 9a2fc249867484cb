// SPDX-License-Identifier: Apache-2.0
// Diagnostics of the rules in sema/checks, one constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "sema/checks/diagnostics.def"
}  // namespace rung::diag
