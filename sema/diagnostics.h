// Messages that declarations, checks and bodies share. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "sema/diagnostics.def"
}  // namespace rung::diag
