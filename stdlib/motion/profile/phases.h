// SPDX-License-Identifier: Apache-2.0
// The two planners share this: the request in coordinates of the axis and the writer of phases. Called by plan.cpp,
// trapezoid.cpp and s_curve.cpp.
#pragma once

#include <math.h>

#include "profile.h"

namespace rung::motion::planning {

inline double square(double x) { return x * x; }
inline double larger(double a, double b) { return a > b ? a : b; }

constexpr double rounding = 2.220446049250313e-16;  // distance of 1 to the next LREAL

// A request whose position counts from the start.
struct Request {
  double velocity, acceleration;  // at the start
  double distance, end_velocity;
  // Distances that differ by less are equal: rounding of the positions that the distance comes from. Without it a
  // motion that is commanded again would go round in a loop when it is a last bit too near.
  double tolerance;
};

// The error that the rounding of a velocity makes in the distance of a ramp with the peak acceleration `acceleration`.
inline double rampRounding(double speed, double acceleration) { return 16 * rounding * square(speed) / acceleration; }

// Writes the phases of a profile for an axis that runs forward or, with `sign` -1, mirrored.
class Writer {
 public:
  Writer(Profile& profile, double sign) : profile_(profile), sign_(sign) {}

  void setSign(double sign) { sign_ = sign; }

  void add(double duration, double acceleration, double jerk) {
    if (!(duration > 0)) {
      if (isnan(duration)) profile_.duration = duration;  // beyond the range of LREAL: the plan is refused
      return;
    }
    acceleration = sign_ * acceleration + 0.0;  // no -0
    jerk = sign_ * jerk + 0.0;
    if (profile_.phase_count > 0) {
      Phase& last = profile_.phases[profile_.phase_count - 1];
      // The acceleration is continuous while the jerk is not 0; where it is 0 a phase ends, so that no rounding of the
      // greater acceleration gets into the smaller.
      const bool goes_on = last.jerk == jerk && (jerk != 0 ? acceleration != 0 : last.acceleration == acceleration);
      if (goes_on && profile_.seam != profile_.phase_count) {
        last.duration += duration;
        return;
      }
      if (profile_.phase_count == Profile::max_phases) return;  // cannot happen: see the longest plan in s_curve.cpp
    }
    profile_.phases[profile_.phase_count++] = {duration, acceleration, jerk};
  }

  void addCruise(double duration, double velocity) {
    profile_.cruise = sign_ * velocity;
    add(duration, 0, 0);
  }

  // The phases that come now are counted from the end.
  void setSeam() { profile_.seam = profile_.phase_count; }

 private:
  Profile& profile_;
  double sign_;
};

// Constant accelerations (trapezoid.cpp). `limits` are the mean accelerations of the ramps.
void trapezoidToPosition(Profile& profile, const Request& request, const Limits& limits);
void trapezoidToVelocity(Profile& profile, const Request& request, const Limits& limits);
// Distance of the ramp from one velocity to the other.
double trapezoidRampDistance(double from, double to, const Limits& limits);

// Limited jerk (s_curve.cpp).
void sCurveToPosition(Profile& profile, const Request& request, const Limits& limits);
void sCurveToVelocity(Profile& profile, const Request& request, const Limits& limits);

}  // namespace rung::motion::planning
