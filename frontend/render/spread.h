// SPDX-License-Identifier: Apache-2.0
// The positions of a file in one direction, spread where elements need more room than in its editor.
// Private to frontend/render: networks (positions.cpp) and charts (chart_positions.cpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "frontend/render/svg.h"

namespace rung::picture {

// For each item: its position in the file, and its extent before and after that point.
struct Axis {
  std::vector<int64_t> wanted;
  std::vector<int32_t> before, after;
};

constexpr int32_t kWidest = 300;  // between adjacent columns with no column in between

// Positions in file order, moved on where an item would be too close to one before it. `gap`: the distance between two
// elements that could overlap; negative: they cannot.
template <class Gap>
std::vector<int32_t> spread(const Axis& axis, Gap gap) {
  const size_t count = axis.wanted.size();
  std::vector<uint32_t> order(count);
  for (uint32_t k = 0; k < count; ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return axis.wanted[a] < axis.wanted[b]; });
  std::vector<int32_t> at(count);
  int64_t now = 0;
  for (size_t first = 0; first < count;) {
    size_t last = first;
    while (last < count && axis.wanted[order[last]] == axis.wanted[order[first]]) ++last;
    if (first > 0) {
      const int64_t step = axis.wanted[order[first]] - axis.wanted[order[first - 1]];
      now += std::min<int64_t>(step, kWidest);
    }
    for (size_t k = first; k < last; ++k)
      for (size_t other = 0; other < first; ++other)
        if (const int32_t free = gap(order[k], order[other]); free >= 0)
          now = std::max<int64_t>(now, at[order[other]] + axis.after[order[other]] + free + axis.before[order[k]]);
    now = (now + kGrid - 1) / kGrid * kGrid;
    for (size_t k = first; k < last; ++k) at[order[k]] = static_cast<int32_t>(now);
    first = last;
  }
  return at;
}

}  // namespace rung::picture
