// SPDX-License-Identifier: Apache-2.0
// Checks requests, hands them to the planner of their ramp, and evaluates profiles.
#include "profile.h"

#include <math.h>

#include "laws.h"
#include "phases.h"

namespace rung::motion {
namespace {

using namespace planning;

bool isSmooth(Ramp ramp) { return ramp == Ramp::Sin2 || ramp == Ramp::QuadraticSmooth; }

bool isJerkLimited(const Limits& limits, Ramp ramp) {
  return ramp == Ramp::Quadratic && limits.jerk > 0 && limits.jerk != HUGE_VAL;
}

// Products and quotients of a few numbers between these are LREALs.
constexpr double greatest = 1e30;
constexpr double smallest = 1e-30;

Result checkNumbers(double a, double b, double c) {
  if (!isfinite(a) || !isfinite(b) || !isfinite(c)) return Result::NotFinite;
  return larger(larger(fabs(a), fabs(b)), fabs(c)) <= greatest ? Result::Ok : Result::OutOfRange;
}

Result checkLimit(double limit) {
  if (!isfinite(limit)) return Result::NotFinite;
  if (!(limit > 0)) return Result::BadLimits;
  return limit >= smallest && limit <= greatest ? Result::Ok : Result::OutOfRange;
}

Result checkLimits(const Limits& limits) {
  if (Result result = checkLimit(limits.acceleration); result != Result::Ok) return result;
  if (Result result = checkLimit(limits.deceleration); result != Result::Ok) return result;
  return limits.jerk == 0 || limits.jerk == HUGE_VAL ? Result::Ok : checkLimit(limits.jerk);
}

Result checkRequest(const State& start, double position, double end_velocity, const Limits& limits) {
  if (Result result = checkNumbers(start.position, start.velocity, start.acceleration); result != Result::Ok)
    return result;
  if (Result result = checkNumbers(position, end_velocity, 0); result != Result::Ok) return result;
  if (Result result = checkLimit(limits.velocity); result != Result::Ok) return result;
  if (Result result = checkLimits(limits); result != Result::Ok) return result;
  return fabs(end_velocity) <= limits.velocity ? Result::Ok : Result::EndVelocityTooHigh;
}

// In motion a position is a rounded sum.
double roundingOf(double position, const State& start) {
  return 32 * rounding * (fabs(position) + fabs(start.position));
}

Limits meanLimits(const Limits& limits, Ramp ramp) {
  const double mean = meanOfPeak(ramp);
  return {limits.velocity, limits.acceleration * mean, limits.deceleration * mean, 0};
}

// The phases are written by the planner.
void begin(Profile& plan, const State& start, Ramp ramp) {
  plan.start = start;
  plan.duration = 0;
  plan.cruise = 0;
  plan.phase_count = 0;
  plan.seam = 0;
  plan.ramp = ramp;
}

void handOut(const Profile& plan, Profile& profile) {
  profile.start = plan.start;
  profile.duration = plan.duration;
  profile.end_position = plan.end_position;
  profile.end_velocity = plan.end_velocity;
  profile.cruise = plan.cruise;
  for (int i = 0; i < plan.phase_count; ++i) profile.phases[i] = plan.phases[i];
  profile.phase_count = plan.phase_count;
  profile.seam = plan.seam;
  profile.ramp = plan.ramp;
}

bool isCruise(const Phase& phase) { return phase.acceleration == 0 && phase.jerk == 0; }

// `t` seconds after the state at the start of a phase.
State advance(const State& state, const Phase& phase, double t) {
  const double a = phase.acceleration;
  return {state.position + t * (state.velocity + t * (a / 2 + t * phase.jerk / 6)),
          state.velocity + t * (a + t * phase.jerk / 2), a + t * phase.jerk};
}

// `t` seconds before the state at the end of phase `i`. With limited jerk the acceleration there is that of the next
// phase, which is not rounded by the greater one before it.
State goBack(const Profile& profile, int i, const State& state, double t) {
  const Phase& phase = profile.phases[i];
  double a = phase.acceleration;
  if (isCruise(phase)) return {state.position - t * profile.cruise, profile.cruise, 0};
  if (phase.jerk != 0) a = i + 1 < profile.phase_count ? profile.phases[i + 1].acceleration : 0;
  return {state.position - t * (state.velocity - t * (a / 2 - t * phase.jerk / 6)),
          state.velocity - t * (a - t * phase.jerk / 2), a - phase.jerk * t};
}

// Both laws cover half of the rectangle, so a whole smooth phase is advanced through like one of its mean acceleration.
State advanceSmoothly(const State& state, const Phase& phase, Ramp ramp, double t) {
  const LawValues law = lawAt(ramp, t / phase.duration);
  const double change = phase.acceleration * phase.duration;
  return {state.position + t * state.velocity + change * phase.duration * law.integral,
          state.velocity + change * law.velocity, phase.acceleration * law.acceleration};
}

// A cruise has its velocity from the profile.
State cruise(const Profile& profile, const State& state, double t) {
  return {state.position + t * profile.cruise, profile.cruise, 0};
}

State endOf(const Profile& profile, const State& state, const Phase& phase) {
  return isCruise(phase) ? cruise(profile, state, phase.duration) : advance(state, phase, phase.duration);
}

// Where the states from the start and from the end differ least, when rounding of great velocities has grown in long
// phases after them.
void moveSeam(Profile& plan) {
  State forward[Profile::max_phases + 1];
  forward[0] = plan.start;
  for (int i = 0; i < plan.phase_count; ++i) forward[i + 1] = endOf(plan, forward[i], plan.phases[i]);
  State state{plan.end_position, plan.end_velocity, 0};
  double least = fabs(forward[plan.phase_count].position - state.position);
  plan.seam = plan.phase_count;
  for (int i = plan.phase_count - 1; i >= 0; --i) {
    state = goBack(plan, i, state, plan.phases[i].duration);
    const double gap = fabs(forward[i].position - state.position);
    if (gap < least) {
      least = gap;
      plan.seam = uint8_t(i);
    }
  }
}

// Fills in what follows from the phases and hands the profile out when every figure is finite. The states meet at the
// seam.
Result finish(Profile& plan, Profile& profile) {
  State state = plan.start;
  double way = fabs(plan.start.position) + fabs(plan.end_position);
  for (int i = 0; i < plan.seam; ++i) {
    const State end = endOf(plan, state, plan.phases[i]);
    plan.duration += plan.phases[i].duration;
    way += fabs(end.position - state.position);
    state = end;
  }
  State back{plan.end_position, plan.end_velocity, 0};
  for (int i = plan.phase_count - 1; i >= plan.seam; --i) {
    const State begin = goBack(plan, i, back, plan.phases[i].duration);
    plan.duration += plan.phases[i].duration;
    way += fabs(back.position - begin.position);
    back = begin;
  }
  if (!isfinite(plan.duration) || !isfinite(way)) return Result::OutOfRange;
  if (!(fabs(state.position - back.position) <= 64 * rounding * way)) moveSeam(plan);
  handOut(plan, profile);
  return Result::Ok;
}

Result finishAt(Profile& plan, double position, double end_velocity, Profile& profile) {
  plan.end_position = position;
  plan.end_velocity = end_velocity;
  return finish(plan, profile);
}

// The end of a velocity move is where its phases lead.
Result finishMoving(Profile& plan, double end_velocity, Profile& profile) {
  State state = plan.start;
  for (int i = 0; i < plan.phase_count; ++i) {
    state = endOf(plan, state, plan.phases[i]);
    plan.duration += plan.phases[i].duration;
  }
  if (!isfinite(plan.duration) || !isfinite(state.position) || !isfinite(state.velocity)) return Result::OutOfRange;
  plan.end_position = state.position;
  plan.end_velocity = end_velocity;
  handOut(plan, profile);
  return Result::Ok;
}

// The state `left` seconds before the end, after the seam.
State atFromEnd(const Profile& profile, double left) {
  State state{profile.end_position, profile.end_velocity, 0};
  for (int i = profile.phase_count - 1; i >= profile.seam; --i) {
    const Phase& phase = profile.phases[i];
    const double before_end = left < phase.duration ? left : phase.duration;
    const bool inside = left <= phase.duration || i == profile.seam;
    if (inside && isSmooth(profile.ramp)) {
      return advanceSmoothly(goBack(profile, i, state, phase.duration), phase, profile.ramp,
                             phase.duration - before_end);
    }
    state = goBack(profile, i, state, before_end);
    if (inside) return state;
    left -= phase.duration;
  }
  return state;
}

}  // namespace

Result planPosition(Profile& profile, const State& start, double position, double end_velocity, const Limits& limits,
                    Ramp ramp) {
  if (Result result = checkRequest(start, position, end_velocity, limits); result != Result::Ok) return result;
  Request request{start.velocity, isJerkLimited(limits, ramp) ? start.acceleration : 0, position - start.position,
                  end_velocity, 0};
  // At rest the distance is exact.
  if (start.velocity != 0 || request.acceleration != 0 || end_velocity != 0) {
    request.tolerance = roundingOf(position, start);
  }
  Profile plan = {};
  begin(plan, start, ramp);
  if (isJerkLimited(limits, ramp)) {
    sCurveToPosition(plan, request, limits);
  } else {
    trapezoidToPosition(plan, request, meanLimits(limits, ramp));
  }
  return finishAt(plan, position, end_velocity, profile);
}

Result planVelocity(Profile& profile, const State& start, double velocity, const Limits& limits, Ramp ramp) {
  if (Result result = checkNumbers(start.position, start.velocity, start.acceleration); result != Result::Ok)
    return result;
  if (Result result = checkNumbers(velocity, 0, 0); result != Result::Ok) return result;
  if (Result result = checkLimits(limits); result != Result::Ok) return result;
  Request request{start.velocity, isJerkLimited(limits, ramp) ? start.acceleration : 0, 0, velocity, 0};
  Profile plan = {};
  begin(plan, start, ramp);
  if (isJerkLimited(limits, ramp)) {
    sCurveToVelocity(plan, request, limits);
  } else {
    trapezoidToVelocity(plan, request, meanLimits(limits, ramp));
  }
  return finishMoving(plan, velocity, profile);
}

Result planContinuous(Profile& profile, const State& start, double position, double end_velocity, const Limits& limits,
                      Ramp ramp) {
  if (Result result = checkRequest(start, position, end_velocity, limits); result != Result::Ok) return result;
  Profile ramp_only = {};
  if (Result result = planVelocity(ramp_only, start, end_velocity, limits, ramp); result != Result::Ok) return result;
  // Both in the direction of the end velocity.
  const double sign = end_velocity < 0 ? -1 : 1;
  const double distance = sign * (position - start.position);
  const double needed = sign * (ramp_only.end_position - start.position);
  const double smaller = limits.acceleration < limits.deceleration ? limits.acceleration : limits.deceleration;
  const double bits =
      roundingOf(position, start) + rampRounding(larger(fabs(start.velocity), fabs(end_velocity)), smaller);
  if (end_velocity != 0 && distance >= 0 && needed > distance - bits) {
    profile = ramp_only;
    if (needed < distance + bits) profile.end_position = position;
    return Result::Ok;
  }
  return planPosition(profile, start, position, end_velocity, limits, ramp);
}

State at(const Profile& profile, double t) {
  const double left = profile.duration - t;
  if (!(left > 0)) return {profile.end_position - profile.end_velocity * left, profile.end_velocity, 0};
  if (!(t > 0)) return profile.start;
  State state = profile.start;
  double begin = 0;  // of the phase
  for (int i = 0; i < profile.seam; ++i) {
    const Phase& phase = profile.phases[i];
    const double inside = t - begin;
    if (inside < phase.duration) {
      if (isCruise(phase)) return cruise(profile, state, inside);
      return isSmooth(profile.ramp) ? advanceSmoothly(state, phase, profile.ramp, inside)
                                    : advance(state, phase, inside);
    }
    begin += phase.duration;
    state = endOf(profile, state, phase);
  }
  return atFromEnd(profile, left);
}

double jerkAt(const Profile& profile, double t) {
  if (!(t >= 0 && t < profile.duration)) return 0;
  for (int i = 0; i < profile.phase_count; ++i) {
    const Phase& phase = profile.phases[i];
    if (t < phase.duration) {
      if (!isSmooth(profile.ramp) || isCruise(phase)) return phase.jerk;
      return phase.acceleration / phase.duration * lawAt(profile.ramp, t / phase.duration).jerk;
    }
    t -= phase.duration;
  }
  return 0;
}

}  // namespace rung::motion
