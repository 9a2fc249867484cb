// SPDX-License-Identifier: Apache-2.0
// What a name of a library is, and how it is written in a program. In: the source of its declaration. Out: its kind,
// and of a function a call with a literal for each input. Used by completion, which lists many of them at a time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/ide/library_index.h"

namespace rung::ide {

enum class LibraryKind : uint8_t {
  Function,
  Block,
  Interface,
  Type,
  Other
};  // Other: an item of an enumeration, a variable

struct LibraryUse {
  LibraryKind kind = LibraryKind::Other;
  std::string call;    // `LIMIT(${1:0}, ${2:0}, ${3:0})`; empty: an input has no literal
  std::string result;  // a literal of the type of the result, as `REAL#0.0`; empty: there is none, or no literal of it
  bool has_result = false;
  std::vector<std::string> pins;  // inputs and in-outs, then outputs
  bool is_for_tests = false;
  bool is_extensible = false;  // takes more arguments than it has pins
};
LibraryUse useOf(const LibraryName& name);

// A literal of an elementary or generic type; empty: there is none.
std::string literalOfType(std::string_view type);

}  // namespace rung::ide
