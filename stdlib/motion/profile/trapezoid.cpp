// SPDX-License-Identifier: Apache-2.0
// Time-optimal plans with constant accelerations: up to a peak velocity, cruise, down to the end velocity, or the
// mirror image. In: a request that is checked; out: phases. The smooth laws share it with their mean accelerations.
#include <math.h>

#include "phases.h"

namespace rung::motion::planning {
namespace {

// Distance that a ramp upwards needs between velocity 0 and `velocity`, by the limit on that side of 0.
double upward(double velocity, const Limits& limits) {
  return square(velocity) / (2 * (velocity > 0 ? limits.acceleration : limits.deceleration));
}

// A ramp upwards has two phases when it crosses velocity 0. `change` is to - from, which may be known better than the
// difference of the two. A ramp downwards is its mirror image.
void addRampUp(Writer& writer, double from, double to, double change, const Limits& limits) {
  if (from < 0 && to > 0) {
    writer.add(-from / limits.deceleration, limits.deceleration, 0);
    writer.add(to / limits.acceleration, limits.acceleration, 0);
  } else {
    const double acceleration = from < 0 ? limits.deceleration : limits.acceleration;
    writer.add(change / acceleration, acceleration, 0);
  }
}

void addRampDown(Writer& writer, double from, double to, double change, const Limits& limits) {
  if (from > 0 && to < 0) {
    writer.add(from / limits.deceleration, -limits.deceleration, 0);
    writer.add(-to / limits.acceleration, -limits.acceleration, 0);
  } else {
    const double acceleration = from > 0 ? limits.deceleration : limits.acceleration;
    writer.add(change / acceleration, -acceleration, 0);
  }
}

void addRamp(Writer& writer, double from, double to, const Limits& limits) {
  if (from <= to) {
    addRampUp(writer, from, to, to - from, limits);
  } else {
    addRampDown(writer, from, to, from - to, limits);
  }
}

// `more` distance than the ramp from start to end velocity gives: over a higher velocity, at most the limit.
// The distance over a peak x >= 0 grows with x^2.
void planOver(Writer& writer, double from, double to, double more, const Limits& limits) {
  const double higher = from > to ? from : to;
  const double growth = more / (1 / (2 * limits.acceleration) + 1 / (2 * limits.deceleration));
  const double peak = sqrt(square(higher) + growth);
  if (peak < limits.velocity) {
    const double change = higher > 0 ? growth / (higher + peak) : peak - higher;
    addRampUp(writer, from, peak, change + (higher - from), limits);
    writer.setSeam();
    addRampDown(writer, peak, to, change + (higher - to), limits);
    return;
  }
  // From above the limit the ramp to the end velocity passes the limit: all that is missing is cruise.
  double cruise = more;
  if (from < limits.velocity) {
    cruise -= (limits.velocity - higher) * (limits.velocity + higher) *
              (1 / (2 * limits.acceleration) + 1 / (2 * limits.deceleration));
  }
  addRamp(writer, from, limits.velocity, limits);
  writer.addCruise(cruise / limits.velocity, limits.velocity);
  writer.setSeam();
  addRamp(writer, limits.velocity, to, limits);
}

}  // namespace

double trapezoidRampDistance(double from, double to, const Limits& limits) {
  if (from > to) return -trapezoidRampDistance(-from, -to, limits);
  if (from < 0 && to > 0) return upward(to, limits) - upward(from, limits);
  return (to - from) * (to + from) / (2 * (from < 0 ? limits.deceleration : limits.acceleration));
}

void trapezoidToPosition(Profile& profile, const Request& request, const Limits& limits) {
  const double more = request.distance - trapezoidRampDistance(request.velocity, request.end_velocity, limits);
  const double sign = more > 0 ? 1 : -1;
  double tolerance = request.tolerance;
  if (sign * request.end_velocity < 0 && sign * request.velocity <= 0) {  // the other way would be a loop
    const double smaller = limits.acceleration < limits.deceleration ? limits.acceleration : limits.deceleration;
    tolerance += rampRounding(larger(fabs(request.velocity), fabs(request.end_velocity)), smaller);
  }
  if (fabs(more) <= tolerance) {
    Writer writer(profile, 1);
    addRamp(writer, request.velocity, request.end_velocity, limits);
    return;
  }
  Writer writer(profile, sign);
  planOver(writer, sign * request.velocity, sign * request.end_velocity, sign * more, limits);
}

void trapezoidToVelocity(Profile& profile, const Request& request, const Limits& limits) {
  Writer writer(profile, 1);
  addRamp(writer, request.velocity, request.end_velocity, limits);
  writer.setSeam();
}

}  // namespace rung::motion::planning
