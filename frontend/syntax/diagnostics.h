// SPDX-License-Identifier: Apache-2.0
// Messages that the parser shares with importers, the checker or the tools. One constant for each row of
// diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/syntax/diagnostics.def"
}  // namespace rung::diag
