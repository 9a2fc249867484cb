// The root of an increasing function between two bounds, by Newton's method inside a bracket. Bounded: each step that
// is not Newton's halves the bracket. Called by s_curve.cpp.
#pragma once

#include <math.h>

namespace rung::motion {

struct Value {
  double value, slope;
};

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
    const bool newton = next > low && next < high;
    // Between bounds of different magnitude the geometric mean finds the magnitude first.
    if (!newton) next = high > 4 * low && low > 0 ? sqrt(low) * sqrt(high) : low + (high - low) / 2;
    if (next == x || !(next > low && next < high)) return x;
    if (newton && fabs(next - x) <= converged * x) return next;
    x = next;
  }
  return x;
}

}  // namespace rung::motion
