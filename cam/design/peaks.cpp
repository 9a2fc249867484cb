// SPDX-License-Identifier: Apache-2.0
// Peaks and limits of cams; see peaks.h.
#include "cam/design/peaks.h"

#include <algorithm>
#include <cmath>

#include "cam/design/words.h"

namespace rung::cam {
namespace {

constexpr double kRounding = 1e-9;  // of a peak, a stroke or a limit: what is smaller is not reported

double power(double speed, size_t order) {
  double factor = 1;
  for (size_t i = 0; i < order; ++i) factor *= speed;
  return factor;
}

void include(Extreme& largest, double x, double step) {
  if (std::fabs(step) > std::fabs(largest.value)) largest = {x, step};
}

}  // namespace

const Extreme& Peak::largest() const { return std::fabs(low.value) > std::fabs(high.value) ? low : high; }

Peaks peaksOf(const Cam& cam, const Curve& curve, double speed) {
  Peaks peaks;
  const std::span<const Piece> pieces = curve.pieces();
  for (int order = 0; order <= 3; ++order) {
    Peak& peak = peaks[static_cast<size_t>(order)];
    const Extremes extremes = curve.extremes(order);
    const double factor = power(speed, static_cast<size_t>(order));
    peak.low = {extremes.low.x, extremes.low.value * factor};
    peak.high = {extremes.high.x, extremes.high.value * factor};
    if (order == 0 || order == 3) continue;
    Extreme& step = peaks[static_cast<size_t>(order) + 1].step;
    for (size_t i = 1; i < pieces.size(); ++i) {
      const double x = pieces[i].from;
      include(step, x, (pieces[i].at(x, order) - pieces[i - 1].at(x, order)) * factor);
    }
    if (cam.repeat != Repeat::Never)
      include(step, cam.start, (pieces.front().at(cam.start, order) - pieces.back().at(cam.end, order)) * factor);
    if (std::fabs(step.value) <= kRounding * std::fabs(peak.largest().value)) step = {};
  }
  // Where the velocity steps, the jerk is not finite either.
  if (!peaks[3].isInfinite()) peaks[3].step = peaks[2].step;
  return peaks;
}

std::vector<Exceeded> exceededLimits(const Limits& limits, const Peaks& peaks) {
  std::vector<Exceeded> all;
  const double margin = kRounding * (peaks[0].high.value - peaks[0].low.value);
  if (limits.low && peaks[0].low.value < *limits.low - margin)
    all.push_back({LimitKind::Low, *limits.low, peaks[0].low, false});
  if (limits.high && peaks[0].high.value > *limits.high + margin)
    all.push_back({LimitKind::High, *limits.high, peaks[0].high, false});
  constexpr LimitKind kKinds[] = {LimitKind::Velocity, LimitKind::Acceleration, LimitKind::Jerk};
  for (size_t i = 0; i < std::size(kKinds); ++i) {
    const std::optional<double>& limit = limits.*kLimitRows[i].value;
    const Peak& peak = peaks[i + 1];
    if (!limit) continue;
    if (peak.isInfinite())
      all.push_back({kKinds[i], *limit, peak.step, true});
    else if (std::fabs(peak.largest().value) > *limit * (1 + kRounding))
      all.push_back({kKinds[i], *limit, peak.largest(), false});
  }
  return all;
}

}  // namespace rung::cam
