// SPDX-License-Identifier: Apache-2.0
// Refuses a command line whose output would replace a source. In: the options. Out: an error message, or an empty
// string. Called by the tool before any command.
#pragma once

#include <string>

#include "tools/driver/options.h"

namespace rung::driver {

[[nodiscard]] std::string checkOutputs(const Options& options);

}  // namespace rung::driver
