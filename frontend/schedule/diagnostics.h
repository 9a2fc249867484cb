// SPDX-License-Identifier: Apache-2.0
// Messages of the schedulers of IL, SFC and networks. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/schedule/diagnostics.def"
}  // namespace rung::diag
