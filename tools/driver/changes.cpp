// SPDX-License-Identifier: Apache-2.0
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
  bool is_open = false;  // the last line of its text, without a line end
};

// Of formatting. Lines with the same characters, blanks aside, correspond to each other: takes lines of both until what
// was read is equal.
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
  for (size_t k = begin; k < end; ++k) {
    out += changes[k].sign + std::string(changes[k].line) + "\n";
    if (changes[k].is_open) out += "\\ No newline at end of file\n";
  }
}

std::string hunksOf(const std::vector<Change>& changes, const std::string& name) {
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

// ---- the shortest list of changes, by E. W. Myers, "An O(ND) Difference Algorithm and Its Variations"

constexpr size_t kMaxChanges = 2000;  // beyond, all lines are exchanged

struct Line {
  std::string_view text;
  bool is_open;
  bool operator==(const Line&) const = default;
};

std::vector<Line> wholeLinesOf(std::string_view text) {
  std::vector<Line> lines;
  for (const std::string_view line : linesOf(text)) lines.push_back({line, false});
  if (!lines.empty() && !text.ends_with('\n')) lines.back().is_open = true;
  return lines;
}

// How far the path on each diagonal comes with 0, 1, 2 … changes, until one is at the end. Empty: too many.
std::vector<std::vector<size_t>> reachOf(const std::vector<Line>& before, const std::vector<Line>& after) {
  std::vector<std::vector<size_t>> reach;
  const size_t most = std::min(kMaxChanges, before.size() + after.size());
  for (size_t d = 0; d <= most; ++d) {
    std::vector<size_t> row(2 * d + 1);  // diagonal k is at k + d
    for (size_t at = 0; at <= 2 * d; at += 2) {
      size_t x = 0;  // lines of `before` that are passed
      if (d > 0) {
        const std::vector<size_t>& last = reach[d - 1];
        const bool adds = at == 0 || (at != 2 * d && last[at - 2] < last[at]);
        x = adds ? last[at] : last[at - 2] + 1;
      }
      size_t y = x + d - at;
      while (x < before.size() && y < after.size() && before[x] == after[y]) ++x, ++y;
      row[at] = x;
      if (x >= before.size() && y >= after.size()) {
        reach.push_back(std::move(row));
        return reach;
      }
    }
    reach.push_back(std::move(row));
  }
  return {};
}

std::vector<Change> shortestChanges(const std::vector<Line>& before, const std::vector<Line>& after) {
  std::vector<Change> changes;
  const auto add = [&](char sign, const Line& line) { changes.push_back({sign, line.text, line.is_open}); };
  const std::vector<std::vector<size_t>> reach = reachOf(before, after);
  if (reach.empty()) {
    for (const Line& line : before) add('-', line);
    for (const Line& line : after) add('+', line);
    return changes;
  }
  size_t x = before.size(), y = after.size();
  for (size_t d = reach.size(); d-- > 0;) {  // backwards
    const size_t at = x + d - y;
    const std::vector<size_t>* const last = d > 0 ? &reach[d - 1] : nullptr;
    const bool adds = d > 0 && (at == 0 || (at != 2 * d && (*last)[at - 2] < (*last)[at]));
    const size_t from = d == 0 ? 0 : adds ? (*last)[at] : (*last)[at - 2] + 1;
    for (; x > from; --y) add(' ', before[--x]);
    if (d == 0) break;
    if (adds)
      add('+', after[--y]);
    else
      add('-', before[--x]);
  }
  std::reverse(changes.begin(), changes.end());
  return changes;
}

}  // namespace

std::string changesOf(std::string_view before, std::string_view after, const std::string& name) {
  return hunksOf(compared(linesOf(before), linesOf(after)), name);
}

std::string unifiedDiff(std::string_view before, std::string_view after, const std::string& name) {
  return hunksOf(shortestChanges(wholeLinesOf(before), wholeLinesOf(after)), name);
}

}  // namespace rung::driver
