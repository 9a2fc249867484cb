// SPDX-License-Identifier: Apache-2.0
// Response files: an argument `@file` is replaced by the words of the file. Called by main.cpp before the command line
// is parsed.
#pragma once

#include <string>
#include <vector>

namespace rung::tool {

// Expands `@file` arguments (shell-like: blanks separate, quotes and backslash group) in place; files may name files.
// Returns an error message for the user, or an empty string.
[[nodiscard]] std::string expandResponseFiles(std::vector<std::string>& arguments);

}  // namespace rung::tool
