// SPDX-License-Identifier: Apache-2.0
// Messages about the command line: inputs, project files, C++ bodies. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "tools/driver/diagnostics.def"
}  // namespace rung::diag
