// SPDX-License-Identifier: Apache-2.0
// C in braces: Beremiz and matiec copy `{ … }` and `{{ … }}` in a body into the C code that they generate. In: the
// content of a pragma. Out: whether it can only be C. Called by the lexer and by conditions.cpp.
#pragma once

#include <algorithm>
#include <string_view>

namespace rung::text {

// Only operators and names that occur in no pragma of an IEC compiler count, and a `;` before any string.
inline bool holdsC(std::string_view text) {
  const auto has = [&](std::string_view what) { return text.find(what) != std::string_view::npos; };
  if (has(":=")) return false;  // ST in braces
  return has("->") || has("==") || has("&&") || has("||") || has("__SET_") || has("__GET_") || has("#include") ||
         text.substr(0, text.find('\'')).find(';') != std::string_view::npos;
}

// The offset after the `}}` of a pragma that begins with `{{` at `at`. npos: another pragma, or not closed.
inline size_t endOfDoubleBrace(std::string_view text, size_t at) {
  if (text.substr(at, 2) != "{{") return std::string_view::npos;
  const size_t close = text.find("}}", at + 2);
  return close == std::string_view::npos ? close : close + 2;
}

}  // namespace rung::text
