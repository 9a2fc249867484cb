// SPDX-License-Identifier: Apache-2.0
// The pragmas that a program may write, and the attributes of `{attribute '…'}`, with a sentence on each.
#pragma once

#include <span>

namespace rung::ide {

struct PragmaWord {
  const char* name;
  bool is_attribute;
  const char* meaning;
  const char* values = nullptr;  // of an attribute, separated by blanks; null: any, or none
};
std::span<const PragmaWord> pragmaWords();

}  // namespace rung::ide
