// SPDX-License-Identifier: Apache-2.0
// Messages of the export to PLCopen XML. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/export/diagnostics.def"
}  // namespace rung::diag
