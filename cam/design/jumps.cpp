// SPDX-License-Identifier: Apache-2.0
// Jumps of cams; see jumps.h.
#include "cam/design/jumps.h"

#include <algorithm>
#include <cmath>

namespace rung::cam {
namespace {

constexpr double kRoundingOfStroke = 1e-9, kRoundingOfPeak = 1e-12;  // of the stroke and of the largest position

// Smaller jumps are rounding.
double leastJump(const Curve& curve) {
  const Extremes slave = curve.extremes(0);
  const double stroke = slave.high.value - slave.low.value, peak = std::fabs(slave.peak().value);
  return std::max(kRoundingOfStroke * stroke, kRoundingOfPeak * peak);
}

}  // namespace

std::vector<Jump> jumpsOf(const Curve& curve) {
  std::vector<Jump> jumps;
  const double least = leastJump(curve);
  const std::span<const Piece> pieces = curve.pieces();
  for (size_t i = 1; i < pieces.size(); ++i) {
    const double x = pieces[i].from, size = pieces[i].at(x, 0) - pieces[i - 1].at(x, 0);
    if (std::fabs(size) > least) jumps.push_back({x, size});
  }
  return jumps;
}

std::optional<double> jumpOfRepeat(const Cam& cam, const Curve& curve, Repeat repeat) {
  const double first = curve.pieces().front().at(cam.start, 0), last = curve.pieces().back().at(cam.end, 0);
  double size = 0;
  switch (repeat) {
    case Repeat::Never: break;
    case Repeat::Closed: size = first - last; break;
    case Repeat::Modulo: size = std::remainder(first - last, cam.slave_period); break;
    case Repeat::Relative: size = first; break;
  }
  return std::fabs(size) > leastJump(curve) ? std::optional(size) : std::nullopt;
}

}  // namespace rung::cam
