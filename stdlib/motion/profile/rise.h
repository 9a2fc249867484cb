// SPDX-License-Identifier: Apache-2.0
// The fastest jerk-limited change of velocity upwards: from (v0, a0) to (v1, a1), both accelerations >= 0. A fall is a
// rise seen backwards in time. Called by s_curve.cpp.
//
// In the plane of velocity and e = a^2 / 2 the jerk limit is a slope: |de/dv| <= jerk. The fastest rise is the highest
// line below a slope up from the start, a slope down to the end and the limits of the acceleration, which differ on the
// two sides of velocity 0: speed falls below it and grows above it.
#pragma once

#include <math.h>

#include "phases.h"

namespace rung::motion::planning {

// Limits of the acceleration while the velocity is below and above 0.
struct Caps {
  double below, above;
};

// Between two velocities with the same limit: jerk up, constant acceleration, jerk down.
struct Stretch {
  double up, flat, down;  // durations
  double peak;
};

struct Rise {
  Stretch stretches[2];
  int count;
  double v0, a0, v1, a1;
  double a_zero;  // acceleration at velocity 0, between the two stretches
  double peak;    // acceleration where the last fall of the acceleration begins
};

inline Stretch stretchOf(double a0, double a1, double change, double cap, double jerk) {
  const double free = (square(a0) + square(a1)) / 2 + jerk * change;
  Stretch stretch{0, 0, 0, cap};
  if (free > square(cap)) {
    stretch.flat = (free - square(cap)) / (jerk * cap);
  } else {
    stretch.peak = sqrt(free > 0 ? free : 0);
  }
  if (stretch.peak > a0) stretch.up = (stretch.peak - a0) / jerk;
  if (stretch.peak > a1) stretch.down = (stretch.peak - a1) / jerk;
  return stretch;
}

// `change` is v1 - v0, which may be known better than the difference of the two.
inline Rise riseOf(double v0, double a0, double v1, double a1, double change, const Caps& caps, double jerk) {
  Rise rise;
  rise.v0 = v0;
  rise.a0 = a0;
  rise.v1 = v1;
  rise.a1 = a1;
  rise.count = 1;
  if (v0 >= 0 || v1 <= 0 || caps.below == caps.above) {
    rise.stretches[0] = stretchOf(a0, a1, change, v0 >= 0 ? caps.above : caps.below, jerk);
    rise.peak = rise.stretches[0].peak;
    return rise;
  }
  const double to_zero = square(a0) - 2 * jerk * v0;
  const double from_zero = square(a1) + 2 * jerk * v1;
  const double cap = caps.below < caps.above ? caps.below : caps.above;
  const bool falls_before = from_zero < to_zero && from_zero < square(cap);
  const double e = to_zero < from_zero ? to_zero : from_zero;
  rise.a_zero = e < square(cap) ? sqrt(e) : cap;
  rise.count = 2;
  rise.stretches[0] = stretchOf(a0, rise.a_zero, -v0, caps.below, jerk);
  rise.stretches[1] = stretchOf(rise.a_zero, a1, v1, caps.above, jerk);
  // What does not exist is rounding: the acceleration only grows before 0, or only falls after it.
  if (rise.a_zero != caps.above) rise.stretches[0].down = falls_before ? rise.stretches[0].down : 0;
  if (falls_before) rise.stretches[1].up = rise.stretches[1].flat = 0;
  rise.peak = falls_before ? rise.stretches[0].peak : rise.stretches[1].peak;
  return rise;
}

inline double stretchDistance(const Stretch& s, double v0, double a0, double v1, double a1, double jerk) {
  double distance =
      s.up * (v0 + s.up * (a0 / 2 + jerk * s.up / 6)) + s.down * (v1 - s.down * (a1 / 2 + jerk * s.down / 6));
  if (s.flat > 0) distance += s.flat * (v0 + s.up * (a0 + jerk * s.up / 2) + s.flat * s.peak / 2);
  return distance;
}

inline double riseDistance(const Rise& rise, double jerk) {
  if (rise.count == 1) return stretchDistance(rise.stretches[0], rise.v0, rise.a0, rise.v1, rise.a1, jerk);
  return stretchDistance(rise.stretches[0], rise.v0, rise.a0, 0, rise.a_zero, jerk) +
         stretchDistance(rise.stretches[1], 0, rise.a_zero, rise.v1, rise.a1, jerk);
}

}  // namespace rung::motion::planning
