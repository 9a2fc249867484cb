// SPDX-License-Identifier: Apache-2.0
// The laws of the smooth velocity ramps on 0 <= s <= 1: velocity from 0 to 1, its integral, and its two derivatives.
// Called by profile.cpp for Ramp::Sin2 and Ramp::QuadraticSmooth.
#pragma once

#include "profile.h"

namespace rung::motion::planning {

struct LawValues {
  double integral, velocity, acceleration, jerk;
};

LawValues lawAt(Ramp ramp, double s);

// Mean acceleration of a ramp whose peak acceleration is 1: 2/pi and 8/15; 1 for the forms without a law.
double meanOfPeak(Ramp ramp);

}  // namespace rung::motion::planning
