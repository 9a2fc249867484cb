// SPDX-License-Identifier: Apache-2.0
// `rung new` and `rung init` share this, and the help about templates.
#pragma once

#include <string>
#include <string_view>

namespace rung::driver {

// A name for `[project] name`, which letters, digits and `_` make up, like that of the folder.
std::string moduleNameOf(std::string_view folder);
// One line for each template of `rung new`.
std::string templateHelp();
// As a shell takes it for one word.
std::string shellWord(const std::string& word);

}  // namespace rung::driver
