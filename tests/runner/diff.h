// SPDX-License-Identifier: Apache-2.0
// The difference of two sequences of lines, as a failing test prints it.
#pragma once

#include <string>
#include <vector>

namespace rung::tests {

// "- expected", "+ actual", "  both" with two lines of context; empty when they are equal.
std::string diff(const std::vector<std::string>& expected, const std::vector<std::string>& actual);

// Like diff, but an expected line `...` matches any number of lines. Empty: they match.
std::string diffWithGaps(const std::vector<std::string>& expected, const std::vector<std::string>& actual);

std::vector<std::string> splitLines(const std::string& text);

}  // namespace rung::tests
