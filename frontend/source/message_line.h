// SPDX-License-Identifier: Apache-2.0
// A line of a message file of an NCT ladder (docs/nct.md): `number<TAB>text`. Used by its reader
// (frontend/import/nct/messages.h) and by the formatter.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace rung {

struct MessageParts {
  std::string_view number, text;  // both without bytes: the line is blank
};

// What separates them ends with its last tab, which keeps the blanks of the text, or is all blanks.
inline MessageParts messageParts(std::string_view line) {
  constexpr std::string_view kBlanks = " \t";
  if (line.ends_with('\r')) line.remove_suffix(1);
  const size_t begin = std::min(line.find_first_not_of(kBlanks), line.size());
  const size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
  size_t text = std::min(line.find_first_not_of(kBlanks, end), line.size());
  const size_t tab = line.substr(end, text - end).rfind('\t');
  if (tab != std::string_view::npos && text < line.size()) text = end + tab + 1;
  return {line.substr(begin, end - begin), line.substr(text)};
}

}  // namespace rung
