// Formats faults for the user: `path:line: fault[div]: division by zero in Main`.
#pragma once

#include <string>

#include "rung/module.h"

namespace rung::host {

std::string describeFault(const rung_module& module, const rung_fault& fault);

}  // namespace rung::host
