// SPDX-License-Identifier: Apache-2.0
// sin^2 and the quintic. sin and cos are polynomials of fixed order: the last bit of libm's differs between C
// libraries.
#include "laws.h"

namespace rung::motion::planning {
namespace {

constexpr double pi = 3.14159265358979323846;

// Taylor polynomials on [0, pi/4]: the first term left out is below 1e-17.
double sine(double x) {
  const double q = x * x;
  double sum = -1.0 / 1307674368000;
  sum = sum * q + 1.0 / 6227020800;
  sum = sum * q - 1.0 / 39916800;
  sum = sum * q + 1.0 / 362880;
  sum = sum * q - 1.0 / 5040;
  sum = sum * q + 1.0 / 120;
  sum = sum * q - 1.0 / 6;
  return x + x * q * sum;
}

double cosine(double x) {
  const double q = x * x;
  double sum = 1.0 / 20922789888000;
  sum = sum * q - 1.0 / 87178291200;
  sum = sum * q + 1.0 / 479001600;
  sum = sum * q - 1.0 / 3628800;
  sum = sum * q + 1.0 / 40320;
  sum = sum * q - 1.0 / 720;
  sum = sum * q + 1.0 / 24;
  return 1 - q * (0.5 - q * sum);
}

// sin(pi x) for 0 <= x <= 1.
double sineOfPi(double x) {
  if (x > 0.5) x = 1 - x;
  return x <= 0.25 ? sine(pi * x) : cosine(pi * (0.5 - x));
}

// cos(pi x) for 0 <= x <= 1.
double cosineOfPi(double x) { return x <= 0.5 ? sineOfPi(0.5 - x) : -sineOfPi(x - 0.5); }

LawValues sineSquared(double s) {
  const double root = sineOfPi(s / 2);
  const double doubled = sineOfPi(s);
  return {s / 2 - doubled / (2 * pi), root * root, pi / 2 * doubled, pi * pi / 2 * cosineOfPi(s)};
}

LawValues quintic(double s) {
  const double r = 1 - s;
  return {s * s * s * s * (2.5 - s * (3 - s)), s * s * s * (10 - s * (15 - 6 * s)), 30 * s * s * r * r,
          60 * s * r * (1 - 2 * s)};
}

}  // namespace

LawValues lawAt(Ramp ramp, double s) { return ramp == Ramp::Sin2 ? sineSquared(s) : quintic(s); }

double meanOfPeak(Ramp ramp) {
  switch (ramp) {
    case Ramp::Sin2: return 2 / pi;
    case Ramp::QuadraticSmooth: return 8.0 / 15;
    case Ramp::Trapezoid:
    case Ramp::Quadratic: break;
  }
  return 1;
}

}  // namespace rung::motion::planning
