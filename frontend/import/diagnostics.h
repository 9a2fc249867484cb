// SPDX-License-Identifier: Apache-2.0
// Messages of the XML reader and of all importers. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/import/diagnostics.def"
}  // namespace rung::diag
