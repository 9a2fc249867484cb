// Messages of the import and export of PLCopen XML. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/plcopen/diagnostics.def"
}  // namespace rung::diag
