// SPDX-License-Identifier: Apache-2.0
// Messages of the lexer and the parsers of ST, IL, textual SFC and the notation of networks. One constant for each row
// of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/parse/diagnostics.def"
}  // namespace rung::diag
