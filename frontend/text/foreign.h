// C in braces: Beremiz and matiec copy `{ … }` and `{{ … }}` in a body into the C code that they make.
// In: the text of a pragma. Out: whether it can only be meant so. The lexer and the conditional pragmas ask.
#pragma once

#include <algorithm>
#include <string_view>

namespace rung::text {

// Only operators and names that no pragma of an IEC compiler has count, and a `;` before any quoted text.
inline bool holdsC(std::string_view text) {
  const auto has = [&](std::string_view what) { return text.find(what) != std::string_view::npos; };
  if (has(":=")) return false;  // ST in braces
  return has("->") || has("==") || has("&&") || has("||") || has("__SET_") || has("__GET_") || has("#include") ||
         text.substr(0, text.find('\'')).find(';') != std::string_view::npos;
}

// Where the pragma that begins with `{{` at `at` ends: behind `}}`. npos: it is another one, or not closed.
inline size_t endOfDoubleBrace(std::string_view text, size_t at) {
  if (text.substr(at, 2) != "{{") return std::string_view::npos;
  const size_t close = text.find("}}", at + 2);
  return close == std::string_view::npos ? close : close + 2;
}

}  // namespace rung::text
