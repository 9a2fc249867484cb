// SPDX-License-Identifier: Apache-2.0
// Shows the changes of a file as a unified diff. In: a source before and after. Out: hunks with three lines around each
// change; empty: they are equal. Called by the commands that change sources.
#pragma once

#include <string>
#include <string_view>

namespace rung::driver {

// Of formatting: they differ in white space and the case of letters only.
std::string changesOf(std::string_view before, std::string_view after, const std::string& name);
// Of any change.
std::string unifiedDiff(std::string_view before, std::string_view after, const std::string& name);

}  // namespace rung::driver
