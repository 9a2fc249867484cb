// SPDX-License-Identifier: Apache-2.0
// Differences of lines: see diff.h.
#include "tests/runner/diff.h"

#include <algorithm>
#include <cstdint>

namespace rung::tests {
namespace {

constexpr size_t kContext = 2;
constexpr size_t kMaxLines = 2000;  // the table of the longest common subsequence is quadratic
constexpr size_t kMaxPrinted = 60;

struct Line {
  char mark;
  const std::string* text;
};

// Lines of the longest common subsequence are unmarked.
std::vector<Line> align(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const size_t n = std::min(a.size(), kMaxLines), m = std::min(b.size(), kMaxLines);
  std::vector<uint16_t> length((n + 1) * (m + 1));
  const auto at = [&](size_t i, size_t j) -> uint16_t& { return length[i * (m + 1) + j]; };
  for (size_t i = n; i-- > 0;) {
    for (size_t j = m; j-- > 0;) {
      at(i, j) = a[i] == b[j] ? static_cast<uint16_t>(at(i + 1, j + 1) + 1) : std::max(at(i + 1, j), at(i, j + 1));
    }
  }
  std::vector<Line> lines;
  size_t i = 0, j = 0;
  while (i < n || j < m) {
    if (i < n && j < m && a[i] == b[j]) {
      lines.push_back({' ', &a[i++]});
      ++j;
    } else if (i < n && (j == m || at(i + 1, j) >= at(i, j + 1))) {
      lines.push_back({'-', &a[i++]});
    } else {
      lines.push_back({'+', &b[j++]});
    }
  }
  return lines;
}

bool matches(const std::vector<std::string>& expected, const std::vector<std::string>& actual) {
  // Greedy with one position to return to: the usual match of a pattern with stars.
  size_t i = 0, j = 0, gap = std::string::npos, resume = 0;
  while (j < actual.size()) {
    if (i < expected.size() && expected[i] == "...") {
      gap = i++;
      resume = j;
    } else if (i < expected.size() && expected[i] == actual[j]) {
      ++i;
      ++j;
    } else if (gap != std::string::npos) {
      i = gap + 1;
      j = ++resume;
    } else {
      return false;
    }
  }
  while (i < expected.size() && expected[i] == "...") ++i;
  return i == expected.size();
}

}  // namespace

std::string diff(const std::vector<std::string>& expected, const std::vector<std::string>& actual) {
  if (expected == actual) return {};
  const std::vector<Line> lines = align(expected, actual);
  std::string out;
  size_t printed = 0;
  bool gap = false;
  for (size_t i = 0; i < lines.size(); ++i) {
    bool near = false;
    for (size_t k = i > kContext ? i - kContext : 0; k <= i + kContext && k < lines.size(); ++k) {
      near = near || lines[k].mark != ' ';
    }
    if (!near) {
      gap = true;
      continue;
    }
    if (++printed > kMaxPrinted) return out + "    ...\n";
    if (gap && !out.empty()) out += "    ...\n";
    gap = false;
    out += std::string("  ") + lines[i].mark + ' ' + *lines[i].text + '\n';
  }
  return out.empty() ? "    (they differ after many equal lines)\n" : out;
}

std::string diffWithGaps(const std::vector<std::string>& expected, const std::vector<std::string>& actual) {
  return matches(expected, actual) ? std::string() : diff(expected, actual);
}

std::vector<std::string> splitLines(const std::string& text) {
  std::vector<std::string> lines;
  size_t start = 0;
  while (start < text.size()) {
    const size_t end = std::min(text.find('\n', start), text.size());
    lines.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return lines;
}

}  // namespace rung::tests
