// SPDX-License-Identifier: Apache-2.0
// The exact extremes of a cam table: of position, slope and curvature between the ends of the table. In: a table that
// check() accepts. Out: the extremes, segment by segment, so that a caller can spread the work over cycles. Called by
// the cam blocks (stdlib/motion/blocks/cam_bounds.cpp): no allocation.
#pragma once

#include "cam/table/table.h"

namespace rung::cam {

struct Range {
  double low, high;
};

struct Bounds {
  Range position, slope, curvature;
};

// Nothing is in it yet.
Bounds emptyBounds();
// Widens `bounds` by a segment. False when its points have become bad.
[[nodiscard]] bool include(const Table& table, int32_t segment, Bounds& bounds);

}  // namespace rung::cam
