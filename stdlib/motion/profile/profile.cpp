// Checks requests, hands them to the planner of their ramp, and evaluates profiles.
#include "profile.h"

#include <math.h>

#include "laws.h"
#include "phases.h"

namespace rung::motion {
namespace {

constexpr double rounding = 2.220446049250313e-16;  // distance of 1 to the next LREAL

bool isSmooth(Ramp ramp) { return ramp == Ramp::Sin2 || ramp == Ramp::QuadraticSmooth; }

bool isJerkLimited(const Limits& limits, Ramp ramp) {
  return ramp == Ramp::Quadratic && limits.jerk > 0 && isfinite(limits.jerk);
}

Result checkStart(const State& start) {
  const bool finite = isfinite(start.position) && isfinite(start.velocity) && isfinite(start.acceleration);
  return finite ? Result::Ok : Result::NotFinite;
}

Result checkLimits(const Limits& limits) {
  if (!isfinite(limits.acceleration) || !isfinite(limits.deceleration) || isnan(limits.jerk)) {
    return Result::NotFinite;
  }
  return limits.acceleration > 0 && limits.deceleration > 0 && limits.jerk >= 0 ? Result::Ok : Result::BadLimits;
}

Result checkRequest(const State& start, double position, double end_velocity, const Limits& limits) {
  if (Result result = checkStart(start); result != Result::Ok) return result;
  if (!isfinite(position) || !isfinite(end_velocity) || !isfinite(limits.velocity)) return Result::NotFinite;
  if (Result result = checkLimits(limits); result != Result::Ok) return result;
  if (!(limits.velocity > 0)) return Result::BadLimits;
  return fabs(end_velocity) <= limits.velocity ? Result::Ok : Result::EndVelocityTooHigh;
}

Limits meanLimits(const Limits& limits, Ramp ramp) {
  const double mean = meanOfPeak(ramp);
  return {limits.velocity, limits.acceleration * mean, limits.deceleration * mean, 0};
}

Profile startOf(const State& start, Ramp ramp) {
  Profile profile{};
  profile.start = start;
  profile.ramp = ramp;
  return profile;
}

State advance(const State& state, const Phase& phase, double t) {
  const double a = phase.acceleration;
  return {state.position + t * (state.velocity + t * (a / 2 + t * phase.jerk / 6)),
          state.velocity + t * (a + t * phase.jerk / 2), a + t * phase.jerk};
}

State advanceSmoothly(const State& state, const Phase& phase, Ramp ramp, double t) {
  if (phase.acceleration == 0) return {state.position + t * state.velocity, state.velocity, 0};
  const LawValues law = lawAt(ramp, t / phase.duration);
  const double change = phase.acceleration * phase.duration;
  return {state.position + t * state.velocity + change * phase.duration * law.integral,
          state.velocity + change * law.velocity, phase.acceleration * law.acceleration};
}

// The state at the end of a phase; both laws cover half of the rectangle.
State endOf(const State& state, const Phase& phase) { return advance(state, phase, phase.duration); }

// Fills in what follows from the phases, and hands the profile out when every figure is finite.
Result finish(Profile& plan, double end_velocity, Profile& profile) {
  State state = plan.start;
  plan.duration = 0;
  for (int i = 0; i < plan.phase_count; ++i) {
    plan.duration += plan.phases[i].duration;
    state = endOf(state, plan.phases[i]);
  }
  if (!isfinite(plan.duration) || !isfinite(state.position) || !isfinite(state.velocity)) {
    return Result::OutOfRange;
  }
  plan.end_position = state.position;
  plan.end_velocity = end_velocity;
  profile = plan;
  return Result::Ok;
}

}  // namespace

Result planPosition(Profile& profile, const State& start, double position, double end_velocity, const Limits& limits,
                    Ramp ramp) {
  if (Result result = checkRequest(start, position, end_velocity, limits); result != Result::Ok) return result;
  Request request{start.velocity, isJerkLimited(limits, ramp) ? start.acceleration : 0, position - start.position,
                  end_velocity, 0};
  // At rest the distance is exact; in motion the position is a rounded sum.
  if (start.velocity != 0 || request.acceleration != 0 || end_velocity != 0) {
    request.tolerance = 16 * rounding * (fabs(position) + fabs(start.position));
  }
  Profile plan = startOf(start, ramp);
  if (isJerkLimited(limits, ramp)) {
    sCurveToPosition(plan, request, limits);
  } else {
    trapezoidToPosition(plan, request, meanLimits(limits, ramp));
  }
  if (Result result = finish(plan, end_velocity, profile); result != Result::Ok) return result;
  profile.end_position = position;
  return Result::Ok;
}

Result planVelocity(Profile& profile, const State& start, double velocity, const Limits& limits, Ramp ramp) {
  if (Result result = checkStart(start); result != Result::Ok) return result;
  if (!isfinite(velocity)) return Result::NotFinite;
  if (Result result = checkLimits(limits); result != Result::Ok) return result;
  Request request{start.velocity, isJerkLimited(limits, ramp) ? start.acceleration : 0, 0, velocity, 0};
  Profile plan = startOf(start, ramp);
  if (isJerkLimited(limits, ramp)) {
    sCurveToVelocity(plan, request, limits);
  } else {
    trapezoidToVelocity(plan, request, meanLimits(limits, ramp));
  }
  return finish(plan, velocity, profile);
}

Result planContinuous(Profile& profile, const State& start, double position, double end_velocity, const Limits& limits,
                      Ramp ramp) {
  if (Result result = checkRequest(start, position, end_velocity, limits); result != Result::Ok) return result;
  Profile ramp_only;
  if (Result result = planVelocity(ramp_only, start, end_velocity, limits, ramp); result != Result::Ok) return result;
  const double distance = position - start.position;
  const double needed = ramp_only.end_position - start.position;
  const bool same_direction = end_velocity != 0 && (distance > 0) == (end_velocity > 0) && distance != 0;
  if (same_direction && fabs(needed) > fabs(distance) && (needed > 0) == (distance > 0)) {
    profile = ramp_only;
    return Result::Ok;
  }
  return planPosition(profile, start, position, end_velocity, limits, ramp);
}

State at(const Profile& profile, double t) {
  if (!(t < profile.duration)) {
    return {profile.end_position + profile.end_velocity * (t - profile.duration), profile.end_velocity, 0};
  }
  State state = profile.start;
  if (!(t > 0)) return state;
  for (int i = 0; i < profile.phase_count; ++i) {
    const Phase& phase = profile.phases[i];
    if (t < phase.duration) {
      return isSmooth(profile.ramp) ? advanceSmoothly(state, phase, profile.ramp, t) : advance(state, phase, t);
    }
    t -= phase.duration;
    state = endOf(state, phase);
  }
  return {profile.end_position, profile.end_velocity, 0};
}

double jerkAt(const Profile& profile, double t) {
  if (!(t >= 0 && t < profile.duration)) return 0;
  for (int i = 0; i < profile.phase_count; ++i) {
    const Phase& phase = profile.phases[i];
    if (t < phase.duration) {
      if (!isSmooth(profile.ramp) || phase.acceleration == 0) return phase.jerk;
      return phase.acceleration / phase.duration * lawAt(profile.ramp, t / phase.duration).jerk;
    }
    t -= phase.duration;
  }
  return 0;
}

}  // namespace rung::motion
