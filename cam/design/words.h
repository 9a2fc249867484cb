// SPDX-License-Identifier: Apache-2.0
// The words of a `.cam` file (docs/cam.md), once for its reader and its writer. In: an enumerator. Out: its word.
#pragma once

#include <string_view>

#include "cam/design/cam.h"

namespace rung::cam {

// By their values.
inline constexpr std::string_view kNumberWords[] = {"", "INT", "UINT", "DINT", "UDINT", "REAL", "LREAL"};
inline constexpr std::string_view kRowWords[] = {"polynomial", "value", "pair", "point"};  // Kind
inline constexpr std::string_view kActionWords[] = {"on", "off", "invert", "pulse"};
inline constexpr std::string_view kDirectionWords[] = {"forward", "both", "backward"};

template <typename Enumerator>
constexpr std::string_view wordOf(const auto& words, Enumerator value) {
  return words[static_cast<size_t>(value)];
}

// The limits of a cam and their keys after `limit`; of those that are above 0.
struct LimitRow {
  std::string_view word;
  std::optional<double> Limits::*value;
};
inline constexpr LimitRow kLimitRows[] = {
    {"velocity", &Limits::velocity},
    {"acceleration", &Limits::acceleration},
    {"jerk", &Limits::jerk},
};

}  // namespace rung::cam
