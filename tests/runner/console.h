// SPDX-License-Identifier: Apache-2.0
// Sessions at a console: `$ command` lines (continued by `> `), each followed by its output; `...` matches any number
// of lines, `[3]` at the end is the exit code. Used by tests/golden/cli and by the documentation.
#pragma once

#include <string>
#include <vector>

#include "tests/runner/support.h"

namespace rung::tests {

// Runs the session in a folder. `updated` gets the lines with the actual output instead of the expected one.
void runSession(const Setting& setting, const std::string& name, const std::vector<std::string>& lines,
                const std::string& folder, std::vector<std::string>& updated, Result& result);

// A folder that contains every top-level entry of the project under its name.
std::string folderLikeRoot(const Setting& setting);

}  // namespace rung::tests
