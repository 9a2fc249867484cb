// SPDX-License-Identifier: Apache-2.0
// The root of an increasing function between two bounds, by Newton's method inside a bracket. Bounded: each step that
// is not Newton's halves the bracket. Called by s_curve.cpp.
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

namespace rung::motion::planning {

struct Value {
  double value, slope;
};

// The cube root of x >= 0 to about 1e-7: a start for Newton's method, without the last bits of libm's cbrt.
inline double roughCubeRoot(double x) {
  if (!(x > 1e-300)) return 0;
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  bits = bits / 3 + (uint64_t(682) << 52);  // a third of the exponent
  double y;
  memcpy(&y, &bits, sizeof y);
  for (int i = 0; i < 2; ++i) y = y * (y * y * y + 2 * x) / (2 * y * y * y + x);
  return y;
}

// f(low) <= 0 <= f(high), 0 <= low. f returns a Value.
template <class Function>
double rootOf(Function f, double low, double high, double guess) {
  constexpr int max_steps = 100;
  constexpr double converged = 1e-9;  // of the last step: the next one is below the rounding
  double x = guess > low && guess < high ? guess : (low + high) / 2;
  for (int step = 0; step < max_steps; ++step) {
    const Value at = f(x);
    if (at.value == 0) return x;
    (at.value > 0 ? high : low) = x;
    double next = x - at.value / at.slope;
    if (next == x) return x;
    const bool newton = next > low && next < high;
    // Between bounds of different magnitude the geometric mean finds the magnitude first.
    if (!newton) next = high > 4 * low && low > 0 ? sqrt(low) * sqrt(high) : low + (high - low) / 2;
    if (!(next > low && next < high)) return x;
    if (newton && fabs(next - x) <= converged * x) return next;
    x = next;
  }
  return x;
}

}  // namespace rung::motion::planning
