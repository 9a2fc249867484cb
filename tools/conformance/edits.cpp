// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/edits.h"

#include <algorithm>

namespace rung::conformance {

std::string rendered(std::string_view text, size_t from, size_t to, std::vector<Edit> edits) {
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) {
    if (a.begin != b.begin) return a.begin < b.begin;
    const size_t first = a.end - a.begin, second = b.end - b.begin;
    return first == 0 || second == 0 ? first < second : first > second;
  });
  std::string out;
  size_t at = from;
  for (const Edit& edit : edits) {
    if (edit.begin < at || edit.begin >= to) continue;
    out += text.substr(at, edit.begin - at);
    out += edit.text;
    at = edit.end;
  }
  if (at < to) out += text.substr(at, to - at);
  return out;
}

std::string lineEndsOf(std::string_view text, size_t from, size_t to) {
  const std::string_view part = text.substr(from, to - from);
  return std::string(static_cast<size_t>(std::count(part.begin(), part.end(), '\n')), '\n');
}

}  // namespace rung::conformance
