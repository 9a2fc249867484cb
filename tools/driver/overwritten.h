// SPDX-License-Identifier: Apache-2.0
// Refuses a command line whose output would replace a source. In: inputs and outputs. Out: an error message, or an
// empty string. Called by the tool before any command.
#pragma once

#include <string>
#include <vector>

namespace rung::driver {

// A file that a command writes, and the option that names it: {"-o", "out.st"}. Where the path is empty, it writes
// none.
struct Output {
  std::string option, path;
};

[[nodiscard]] std::string checkOutputs(const std::vector<std::string>& inputs, const std::vector<Output>& outputs);

}  // namespace rung::driver
