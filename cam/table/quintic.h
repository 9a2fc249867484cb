// SPDX-License-Identifier: Apache-2.0
// The polynomial of degree 5 that meets position, slope and curvature at both ends of a segment. In: those, and the
// length. Out: its factors, and what it adds to the values at its begin. Called by table.cpp, the fit (cam/fit) and the
// approach of MC_GearInPos (stdlib/motion/blocks/gear.cpp); it needs no library.
#pragma once

namespace rung::cam {

// Of s to s^5, where s goes from 0 to 1.
struct Quintic {
  double c1, c2, c3, c4, c5;

  // Position minus that at the begin; the other two are per s and per s².
  double way(double s) const { return s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))); }
  double slopeChange(double s) const { return s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5))); }
  double curvatureChange(double s) const { return s * (6 * c3 + s * (12 * c4 + s * 20 * c5)); }
};

struct QuinticEnd {
  double position, slope, curvature;
};

// Inline: a call takes as long as the polynomial.
__attribute__((always_inline)) inline Quintic quinticOf(const QuinticEnd& from, const QuinticEnd& to, double length) {
  const double half = length * length / 2, way = to.position - from.position;
  const double v0 = from.slope * length, v1 = to.slope * length, a0 = from.curvature * half, a1 = to.curvature * half;
  return {v0, a0, 10 * way - 6 * v0 - 4 * v1 - 3 * a0 + a1, -15 * way + 8 * v0 + 7 * v1 + 3 * a0 - 2 * a1,
          6 * way - 3 * (v0 + v1) - a0 + a1};
}

}  // namespace rung::cam
