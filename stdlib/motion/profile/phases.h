// What the two planners share: the request in coordinates of the axis and the writer of phases. Called by plan.cpp,
// trapezoid.cpp and s_curve.cpp.
#pragma once

#include "profile.h"

namespace rung::motion {

// A request whose position counts from the start.
struct Request {
  double velocity, acceleration;  // at the start
  double distance, end_velocity;
  double tolerance;  // distances that differ by less are equal: rounding of the positions that the distance comes from
};

// Writes the phases of a profile for an axis that runs forward or, with `sign` -1, mirrored.
class Writer {
 public:
  Writer(Profile& profile, double sign) : profile_(profile), sign_(sign) {}

  void setSign(double sign) { sign_ = sign; }

  void add(double duration, double acceleration, double jerk) {
    if (!(duration > 0)) return;
    acceleration *= sign_;
    jerk *= sign_;
    if (profile_.phase_count > 0) {
      Phase& last = profile_.phases[profile_.phase_count - 1];
      // The acceleration is continuous while the jerk is not 0.
      if (last.jerk == jerk && (jerk != 0 || last.acceleration == acceleration)) {
        last.duration += duration;
        return;
      }
      if (profile_.phase_count == Profile::max_phases) return;  // cannot happen: see the longest plan in s_curve.cpp
    }
    profile_.phases[profile_.phase_count++] = {duration, acceleration, jerk};
  }

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

}  // namespace rung::motion
