// SPDX-License-Identifier: Apache-2.0
// Shows the changes of formatting as a unified diff. In: a source before and after; they differ in white space and the
// case of letters only. Out: hunks with three lines around each change; empty: they are equal. Called by fmt.cpp.
#pragma once

#include <string>
#include <string_view>

namespace rung::driver {

std::string changesOf(std::string_view before, std::string_view after, const std::string& name);

}  // namespace rung::driver
