// SPDX-License-Identifier: Apache-2.0
// Closed-form ramps: see ramps.h.
#include "drive/ramps.h"

#include <math.h>

namespace rung::motion {
namespace {

struct Segment {
  double acceleration, duration;
};

// The segments of the shortest motion over `distance` >= the stopping distance, with velocity >= 0.
int planForward(double distance, double velocity, const ProfileLimits& limits, Segment* segments) {
  int count = 0;
  const double a = limits.acceleration, d = limits.deceleration;
  if (velocity > limits.velocity) {
    segments[count++] = {-d, (velocity - limits.velocity) / d};
    distance -= (velocity * velocity - limits.velocity * limits.velocity) / (2 * d);
    velocity = limits.velocity;
  }
  double peak = sqrt((2 * a * d * distance + d * velocity * velocity) / (a + d));
  double cruise = 0;
  if (peak > limits.velocity) {
    peak = limits.velocity;
    cruise = distance - (peak * peak - velocity * velocity) / (2 * a) - peak * peak / (2 * d);
  }
  segments[count++] = {a, peak > velocity ? (peak - velocity) / a : 0};
  segments[count++] = {0, cruise > 0 ? cruise / peak : 0};
  segments[count++] = {-d, peak / d};
  return count;
}

}  // namespace

MotionPoint rampVelocity(MotionPoint from, double target, double rate, double seconds) {
  const double change = target - from.velocity;
  const double needed = fabs(change) / rate;
  if (needed >= seconds) {
    const double velocity = from.velocity + copysign(rate * seconds, change);
    return {from.position + (from.velocity + velocity) / 2 * seconds, velocity};
  }
  return {from.position + (from.velocity + target) / 2 * needed + target * (seconds - needed), target};
}

MotionPoint moveTo(MotionPoint from, double target, const ProfileLimits& limits, double seconds) {
  const double stop = from.velocity * fabs(from.velocity) / (2 * limits.deceleration);
  const double beyond = target - from.position - stop;  // what is left when it brakes now
  const double tolerance = 1e-9 * (1 + fabs(target - from.position));
  Segment segments[5];
  int count = 0;
  double sign = 1;
  if (fabs(beyond) <= tolerance) {
    sign = from.velocity < 0 ? -1 : 1;
    segments[count++] = {-limits.deceleration, fabs(from.velocity) / limits.deceleration};
  } else if (from.velocity != 0 && (beyond < 0) == (from.velocity > 0)) {
    // It moves away from the target, or too fast to stop there: brakes, then returns.
    sign = from.velocity < 0 ? -1 : 1;
    segments[count++] = {-limits.deceleration, fabs(from.velocity) / limits.deceleration};
    Segment back[4];
    const int more = planForward(fabs(beyond), 0, limits, back);
    for (int i = 0; i < more; ++i) segments[count++] = {-back[i].acceleration, back[i].duration};
  } else {
    sign = beyond < 0 ? -1 : 1;
    count = planForward(fabs(target - from.position), fabs(from.velocity), limits, segments);
  }
  MotionPoint at = from;
  for (int i = 0; i < count; ++i) {
    const double acceleration = sign * segments[i].acceleration;
    const double time = segments[i].duration < seconds ? segments[i].duration : seconds;
    at.position += at.velocity * time + acceleration / 2 * time * time;
    at.velocity += acceleration * time;
    if (segments[i].duration > seconds) return at;
    seconds -= segments[i].duration;
  }
  return {target, 0};
}

}  // namespace rung::motion
