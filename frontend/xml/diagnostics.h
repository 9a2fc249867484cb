// Messages of the XML reader, and those that several importers share. One constant for each row of diagnostics.def.
#pragma once

#include "frontend/source/diagnostics.h"

namespace rung::diag {
#include "frontend/xml/diagnostics.def"
}  // namespace rung::diag
