// SPDX-License-Identifier: Apache-2.0
// Diagnostics of the reader of IR text, one constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "ir/diagnostics.def"
}  // namespace rung::diag
