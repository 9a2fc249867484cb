// SPDX-License-Identifier: Apache-2.0
// "Did you mean": the candidate with the least Damerau-Levenshtein distance (optimal string alignment, case folded), or
// one with the same beginning.
// Candidates are rejected by length and character set first, so a scope of 100 000 names is cheap.
#include <algorithm>
#include <bit>

#include "frontend/source/diagnostics.h"
#include "frontend/source/names.h"

namespace rung {
namespace {

constexpr size_t kMaxLength = 64;  // longer names get no suggestion

unsigned char foldedByte(char c) { return static_cast<unsigned char>(foldedCharacter(c)); }

uint64_t characterSet(std::string_view text) {
  uint64_t set = 0;
  for (const char c : text) set |= uint64_t{1} << (foldedByte(c) & 63);
  return set;
}

// The distance, or limit + 1 when it is larger.
size_t distance(std::string_view a, std::string_view b, size_t limit) {
  size_t rows[3][kMaxLength + 1];
  size_t *before = rows[0], *last = rows[1], *row = rows[2];
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    size_t least = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool equal = foldedByte(a[i - 1]) == foldedByte(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (equal ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && foldedByte(a[i - 1]) == foldedByte(b[j - 2]) &&
                           foldedByte(a[i - 2]) == foldedByte(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    if (least > limit) return limit + 1;
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

constexpr size_t kLeastPrefix = 4;  // characters of a beginning that says something

bool beginsWith(std::string_view text, std::string_view beginning) {
  return text.size() > beginning.size() && std::equal(beginning.begin(), beginning.end(), text.begin(),
                                                      [](char a, char b) { return foldedByte(a) == foldedByte(b); });
}

}  // namespace

std::string_view nearest(std::string_view written, const std::vector<std::string_view>& candidates) {
  if (written.size() < 2 || written.size() > kMaxLength) return {};
  size_t limit = written.size() < 6 ? 1 : written.size() / 3;  // one letter in a short name, a third of a long one
  limit = std::min<size_t>(limit, 4);
  const uint64_t written_set = characterSet(written);
  std::string_view best;
  size_t best_distance = limit + 1;
  for (const std::string_view candidate : candidates) {
    if (candidate.empty() || candidate.size() > kMaxLength || candidate == written) continue;
    const size_t longer = std::max(candidate.size(), written.size());
    if (longer - std::min(candidate.size(), written.size()) > limit) continue;
    if (static_cast<size_t>(std::popcount(characterSet(candidate) ^ written_set)) > 2 * limit) continue;
    const size_t d = distance(written, candidate, std::min(limit, best_distance));
    // Ties go to what begins as `written` does, then to the first in alphabetical order, so the answer does not depend
    // on the order of the scope.
    const bool begins = beginsWith(candidate, written), best_begins = beginsWith(best, written);
    const bool wins_tie = begins != best_begins ? begins : candidate < best;
    if (d < best_distance || (d == best_distance && d <= limit && wins_tie)) {
      best = candidate;
      best_distance = d;
    }
  }
  return best;
}

std::string_view nearestByBeginning(std::string_view written, const std::vector<std::string_view>& candidates) {
  std::string_view longer, shorter;
  for (const std::string_view candidate : candidates) {
    if (written.size() >= kLeastPrefix && beginsWith(candidate, written)) {
      const bool better = longer.empty() || candidate.size() < longer.size();
      if (better || (candidate.size() == longer.size() && candidate < longer)) longer = candidate;
    }
    if (candidate.size() >= kLeastPrefix && beginsWith(written, candidate) && written[candidate.size()] == '_' &&
        candidate.size() > shorter.size())
      shorter = candidate;
  }
  return longer.empty() ? shorter : longer;
}

}  // namespace rung
