// Messages of the scheduler of networks. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/diagram/diagnostics.def"
}  // namespace rung::diag
