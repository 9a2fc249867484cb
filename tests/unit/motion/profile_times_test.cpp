// SPDX-License-Identifier: Apache-2.0
// The duration of profiles against a solver that knows no closed form: ramps are integrated in small steps of the
// velocity below all limits of the acceleration, forwards and backwards, and the cruise velocity is found by bisection.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/motion/profile_checks.h"

namespace rung::motion {
namespace {

constexpr int steps = 4000;

struct Ramped {
  double time, distance;
};

// From rest to rest of the acceleration; e = a^2 / 2 changes by at most jerk * dv.
Ramped rampUp(double from, double to, double below, double above, double jerk) {
  const double dv = (to - from) / steps;
  std::vector<double> e(steps + 1);
  e[0] = 0;
  const auto cap = [&](int i) {
    const double v = from + (i + 0.5) * dv;
    const double limit = v < 0 ? below : above;
    return limit * limit / 2;
  };
  for (int i = 1; i <= steps; ++i) e[i] = std::min(e[i - 1] + jerk * dv, std::min(cap(i - 1), cap(i)));
  e[steps] = 0;
  for (int i = steps - 1; i >= 0; --i) e[i] = std::min(e[i], e[i + 1] + jerk * dv);
  Ramped sum{0, 0};
  for (int i = 0; i < steps; ++i) {
    const double t = 2 * dv / (std::sqrt(2 * e[i]) + std::sqrt(2 * e[i + 1]));
    sum.time += t;
    sum.distance += t * (from + (i + 0.5) * dv);
  }
  return sum;
}

// Up to the peak and down to the end velocity; the fall is a rise backwards in time.
Ramped overPeak(double from, double peak, double to, const Limits& l) {
  const Ramped up = peak > from ? rampUp(from, peak, l.deceleration, l.acceleration, l.jerk) : Ramped{0, 0};
  const Ramped down = peak > to ? rampUp(to, peak, l.acceleration, l.deceleration, l.jerk) : Ramped{0, 0};
  return {up.time + down.time, up.distance + down.distance};
}

double solve(double from, double to, double distance, const Limits& l) {
  const double lowest = std::max(from, to);
  if (distance < overPeak(from, lowest, to, l).distance) {
    return solve(-from, -to, -distance, l);
  }
  const Ramped full = overPeak(from, l.velocity, to, l);
  if (distance >= full.distance) return full.time + (distance - full.distance) / l.velocity;
  double low = lowest;
  double high = l.velocity;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (overPeak(from, middle, to, l).distance < distance ? low : high) = middle;
  }
  return overPeak(from, high, to, l).time;
}

TEST(ProfileTimes, SameAsANumericSolver) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    Request r;
    r.limits = {random.magnitude(0.5, 5), random.magnitude(0.3, 3), random.magnitude(0.3, 3), random.magnitude(0.3, 5)};
    r.start.velocity = random.chance(0.2) ? 0 : random.uniform(-0.95, 0.95) * r.limits.velocity;
    r.end_velocity = random.chance(0.5) ? 0 : random.uniform(-0.95, 0.95) * r.limits.velocity;
    r.position = random.sign() * random.magnitude(0.1, 100);
    Profile profile;
    ASSERT_EQ(int(plan(profile, r)), int(Result::Ok)) << print(r);
    const double expected = solve(r.start.velocity, r.end_velocity, r.position, r.limits);
    // The steps of the solver cost it accuracy where the acceleration begins and ends.
    EXPECT_NEAR(duration(profile), expected, 5e-3 * expected) << print(r);
  }
}

}  // namespace
}  // namespace rung::motion
