// SPDX-License-Identifier: Apache-2.0
// Fits a cam to points: the smooth curve of the least squared error that meets wishes and keeps limits, also between
// the points. In: points with weights, and the wishes. Out: a cam of quintic points and a report, or why there is no
// such curve. The same request gives the same cam, bit for bit. Called by `rung cam fit`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cam/design/cam.h"

namespace rung::cam {

inline constexpr size_t kMostFitSegments = 500;

struct Sample {
  double x = 0, y = 0;
  double weight = 1;
};

// The curve goes through it.
struct ExactPoint {
  double x = 0, y = 0;
};

// The slave rests.
struct Dwell {
  double from = 0, to = 0;
  std::optional<double> y;  // none: where it fits best
};

struct EndCondition {
  std::optional<double> slope, curvature;  // per unit of the master
};

// C2: the acceleration is continuous; C3: the jerk too.
enum class Smoothness : uint8_t { C2, C3 };

// How much a point counts that is far from the curve.
enum class Loss : uint8_t { Squares, Huber, Cauchy, Tukey };

struct FitRequest {
  std::vector<Sample> samples;  // in ascending order of x; several may be at one x
  std::vector<ExactPoint> exact;
  std::vector<Dwell> dwells;
  EndCondition at_start, at_end;
  Repeat repeat = Repeat::Never;
  double slave_period = 0;           // of Modulo
  Limits limits;                     // per second: `speed` is given where one of a derivative is
  std::optional<double> start, end;  // of the master; else the first and the last point
  Smoothness smoothness = Smoothness::C2;
  Loss loss = Loss::Squares;
  std::optional<double> loss_scale;  // error from which a point counts less; else estimated
  size_t most_segments = 100;
  std::optional<double> tolerance;  // stop at this largest error; else at the noise of the points
};

struct FitReport {
  Extreme max_error;  // of the points: where, and curve minus point
  double rms_error = 0;
  size_t segments = 0;
  int iterations = 0;         // of the solver that keeps the limits
  int robust_iterations = 0;  // of the robust loss
  size_t outliers = 0;        // points that count less than half
};

struct FitResult {
  Cam cam;  // without a name
  FitReport report;
  std::string error;  // empty: fitted
};
[[nodiscard]] FitResult fit(const FitRequest& request);

}  // namespace rung::cam
