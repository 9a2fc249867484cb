// Messages of the importers of TwinCAT, CODESYS 2.3 and MULTIPROG. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/vendor/diagnostics.def"
}  // namespace rung::diag
