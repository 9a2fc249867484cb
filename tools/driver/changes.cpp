// SPDX-License-Identifier: Apache-2.0
// Lines with the same characters, blanks aside, correspond to each other: no search for the longest common part.
#include "tools/driver/changes.h"

#include <algorithm>
#include <vector>

#include "frontend/source/names.h"

namespace rung::driver {
namespace {

constexpr size_t kAround = 3;

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string withoutBlanks(std::string_view line) {
  std::string out;
  for (const char c : line)
    if (c != ' ' && c != '\t' && c != '\r' && c != '\f' && c != '\v') out += c;
  return foldedIdentifier(out);
}

struct Change {
  char sign;  // ' ', '-' or '+'
  std::string_view line;
};

// Takes lines of both until what was read is equal.
std::vector<Change> compared(const std::vector<std::string_view>& before, const std::vector<std::string_view>& after) {
  std::vector<Change> changes;
  size_t i = 0, j = 0;
  while (i < before.size() || j < after.size()) {
    if (i < before.size() && j < after.size() && before[i] == after[j]) {
      changes.push_back({' ', before[i++]});
      ++j;
      continue;
    }
    std::string old_text, new_text;
    std::vector<Change> added;
    do {
      if (i < before.size() && (old_text.size() <= new_text.size() || j == after.size())) {
        old_text += withoutBlanks(before[i]);
        changes.push_back({'-', before[i++]});
      } else if (j < after.size()) {
        new_text += withoutBlanks(after[j]);
        added.push_back({'+', after[j++]});
      }
    } while (old_text != new_text && (i < before.size() || j < after.size()));
    changes.insert(changes.end(), added.begin(), added.end());
  }
  return changes;
}

void appendHunk(std::string& out, const std::vector<Change>& changes, size_t begin, size_t end, size_t old_line,
                size_t new_line) {
  const auto count = [&](char without) {
    return static_cast<size_t>(std::count_if(changes.begin() + static_cast<std::ptrdiff_t>(begin),
                                             changes.begin() + static_cast<std::ptrdiff_t>(end),
                                             [&](const Change& c) { return c.sign != without; }));
  };
  const auto range = [](size_t line, size_t lines) {
    return std::to_string(lines == 0 ? line - 1 : line) + (lines == 1 ? "" : "," + std::to_string(lines));
  };
  out += "@@ -" + range(old_line, count('+')) + " +" + range(new_line, count('-')) + " @@\n";
  for (size_t k = begin; k < end; ++k) out += changes[k].sign + std::string(changes[k].line) + "\n";
}

}  // namespace

std::string changesOf(std::string_view before, std::string_view after, const std::string& name) {
  const std::vector<Change> changes = compared(linesOf(before), linesOf(after));
  std::string out;
  size_t old_line = 1, new_line = 1, at = 0;
  const auto skipTo = [&](size_t to) {
    for (; at < to; ++at) {
      old_line += changes[at].sign != '+';
      new_line += changes[at].sign != '-';
    }
  };
  for (size_t k = 0; k < changes.size(); ++k) {
    if (changes[k].sign == ' ') continue;
    const size_t begin = std::max(at, k > kAround ? k - kAround : 0);
    size_t end = k, same = 0;
    for (; end < changes.size() && same <= 2 * kAround; ++end) same = changes[end].sign == ' ' ? same + 1 : 0;
    end -= same > kAround ? same - kAround : 0;
    if (out.empty()) out = "--- " + name + "\n+++ " + name + "\n";
    skipTo(begin);
    appendHunk(out, changes, begin, end, old_line, new_line);
    skipTo(end);
    k = end - 1;
  }
  return out;
}

}  // namespace rung::driver
