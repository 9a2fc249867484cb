// SPDX-License-Identifier: Apache-2.0
// A cam asks this of the slave's axis at a speed of the master: the exact extremes of position, velocity, acceleration
// and jerk, and the steps where pieces meet and where the cam repeats. In: a cam and its curve. Out: peaks per second,
// and which limits they exceed. Called by `rung cam check`, `show` and `fit`.
#pragma once

#include <array>
#include <vector>

#include "cam/design/cam.h"

namespace rung::cam {

// Of a derivative: 0 position, 1 velocity, 2 acceleration, 3 jerk.
struct Peak {
  Extreme low, high;
  Extreme step;  // the largest step of the derivative below it, which makes this one infinite; value 0: none

  bool isInfinite() const { return step.value != 0; }
  const Extreme& largest() const;
};

using Peaks = std::array<Peak, 4>;
// `speed` of the master per second; 1: per unit of the master.
Peaks peaksOf(const Cam& cam, const Curve& curve, double speed);

enum class LimitKind : uint8_t { Low, High, Velocity, Acceleration, Jerk };
struct Exceeded {
  LimitKind kind;
  double limit;
  Extreme peak;
  bool is_infinite;  // `peak` is the step
};
std::vector<Exceeded> exceededLimits(const Limits& limits, const Peaks& peaks);

}  // namespace rung::cam
