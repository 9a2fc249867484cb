// Time-optimal plans with constant accelerations: up to a peak velocity, cruise, down to the end velocity, or the
// mirror image. In: a request that is checked; out: phases. The smooth laws share it with their mean accelerations.
#include <math.h>

#include "phases.h"

namespace rung::motion {
namespace {

double square(double x) { return x * x; }

// Distance that a ramp upwards needs between velocity 0 and `velocity`, by the limit on that side of 0.
double upward(double velocity, const Limits& limits) {
  return square(velocity) / (2 * (velocity > 0 ? limits.acceleration : limits.deceleration));
}

// A ramp has two phases when it crosses velocity 0.
void addRamp(Writer& writer, double from, double to, const Limits& limits) {
  if (from <= to) {
    if (from < 0) writer.add(((to < 0 ? to : 0) - from) / limits.deceleration, limits.deceleration, 0);
    if (to > 0) writer.add((to - (from > 0 ? from : 0)) / limits.acceleration, limits.acceleration, 0);
  } else {
    if (from > 0) writer.add((from - (to > 0 ? to : 0)) / limits.deceleration, -limits.deceleration, 0);
    if (to < 0) writer.add(((from < 0 ? from : 0) - to) / limits.acceleration, -limits.acceleration, 0);
  }
}

// More distance than the ramp from start to end velocity gives: over a higher velocity, at most the limit.
void planOver(Writer& writer, double from, double to, double distance, const Limits& limits) {
  const double rise = upward(from, limits);
  const double fall = upward(-to, limits);  // seen backwards in time the fall is a rise of -v
  const double slope = 1 / (2 * limits.acceleration) + 1 / (2 * limits.deceleration);
  double peak = limits.velocity;
  double cruise = 0;
  if (from <= limits.velocity) {
    const double needed = (distance + rise + fall) / slope;
    if (needed < square(limits.velocity)) {
      peak = sqrt(needed > 0 ? needed : 0);
      if (peak < from) peak = from;
      if (peak < to) peak = to;
    }
  }
  if (peak == limits.velocity) {
    cruise = (distance - trapezoidRampDistance(from, peak, limits) - trapezoidRampDistance(peak, to, limits)) / peak;
  }
  addRamp(writer, from, peak, limits);
  writer.add(cruise, 0, 0);
  addRamp(writer, peak, to, limits);
}

}  // namespace

double trapezoidRampDistance(double from, double to, const Limits& limits) {
  return from <= to ? upward(to, limits) - upward(from, limits) : upward(-from, limits) - upward(-to, limits);
}

void trapezoidToPosition(Profile& profile, const Request& request, const Limits& limits) {
  const double excess = request.distance - trapezoidRampDistance(request.velocity, request.end_velocity, limits);
  if (fabs(excess) <= request.tolerance) {
    trapezoidToVelocity(profile, request, limits);
    return;
  }
  const double sign = excess > 0 ? 1 : -1;
  Writer writer(profile, sign);
  planOver(writer, sign * request.velocity, sign * request.end_velocity, sign * request.distance, limits);
}

void trapezoidToVelocity(Profile& profile, const Request& request, const Limits& limits) {
  Writer writer(profile, 1);
  addRamp(writer, request.velocity, request.end_velocity, limits);
}

}  // namespace rung::motion
