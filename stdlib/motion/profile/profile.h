// SPDX-License-Identifier: Apache-2.0
// Motion profiles of one axis: from any start state to a position with an end velocity, or to a velocity, as fast as
// the limits allow. In: a start state, limits and the form of the ramps; out: a Profile, plain data that at() evaluates
// at any time in closed form. Called by the motion blocks (stdlib/motion); needs nothing of the runtime. No allocation,
// no exceptions, no state outside the arguments, bounded time; only + - * / and square roots, so that the same request
// gives the same bits on every machine (compile with -ffp-contract=off, never with -ffast-math).
#pragma once

#include <stdint.h>

namespace rung::motion {

// Form of the velocity ramps; the values of SMC_RAMPTYPE.
enum class Ramp : uint8_t {
  Trapezoid = 0,        // constant acceleration
  Sin2 = 1,             // v0 + (v1 - v0) * sin^2: peak acceleration is the limit, acceleration 0 at both ends
  Quadratic = 2,        // jerk-limited; with jerk 0 or infinite a trapezoid
  QuadraticSmooth = 3,  // quintic velocity: acceleration and jerk are continuous, peak acceleration is the limit
};

struct State {
  double position = 0, velocity = 0, acceleration = 0;
};

// Magnitudes. `acceleration` holds while the speed |v| grows, `deceleration` while it falls.
struct Limits {
  double velocity = 0;
  double acceleration = 0;
  double deceleration = 0;
  double jerk = 0;  // of Ramp::Quadratic; 0 or infinite: not limited
};

enum class Result : uint8_t {
  Ok = 0,
  NotFinite,           // NaN or infinity in the start state, the target or a limit (an infinite jerk is allowed)
  BadLimits,           // a limit <= 0 or jerk < 0
  EndVelocityTooHigh,  // |end velocity| above the velocity limit
  OutOfRange,          // a number above 1e30, a limit below 1e-30, or a profile whose figures are beyond LREAL
};

// One stretch of a profile. Sin2 and QuadraticSmooth: `acceleration` is the mean of the stretch, and jerk is 0.
struct Phase {
  double duration, acceleration, jerk;
};

// A plan. All bytes 0: at rest at 0 for ever.
struct alignas(8) Profile {
  static constexpr int max_phases = 14;
  State start;
  double duration;      // sum of the phases
  double end_position;  // at `duration`, exactly
  double end_velocity;  // from `duration` on, for ever
  double cruise;        // velocity of the phase without acceleration: a rounded sum would drift in a long one
  Phase phases[max_phases];
  uint8_t phase_count;
  uint8_t seam;  // from this phase on states are counted back from the end, so that the arrival is exact
  Ramp ramp;
};
static_assert(sizeof(Profile) <= 400 && alignof(Profile) == 8);

// To `position`, arriving with `end_velocity` (signed) and acceleration 0, in the least time. Where the way is too
// short, the axis brakes, goes back and arrives as asked. The start acceleration counts with Ramp::Quadratic only; the
// other forms may jump in it. A start beyond a limit goes back into it at once and monotonically. When the result is
// not Ok, the profile is unchanged.
[[nodiscard]] Result planPosition(Profile& profile, const State& start, double position, double end_velocity,
                                  const Limits& limits, Ramp ramp);

// The same without going back: when `end_velocity` cannot be reached on the way to `position`, the axis crosses it with
// what it has reached and goes on to the end velocity; end_position is then where it reaches that. Where
// the end velocity points away from the target, the axis turns; planned again while it goes back for the run-up, the
// target lies ahead and may be crossed.
[[nodiscard]] Result planContinuous(Profile& profile, const State& start, double position, double end_velocity,
                                    const Limits& limits, Ramp ramp);

// To a velocity in the least time, then constant for ever. limits.velocity is not looked at.
[[nodiscard]] Result planVelocity(Profile& profile, const State& start, double velocity, const Limits& limits,
                                  Ramp ramp);

inline double duration(const Profile& profile) { return profile.duration; }

// The state `t` seconds after the start; before the start the start state, from `duration` on the end velocity,
// constant.
[[nodiscard]] State at(const Profile& profile, double t);
// The jerk there, 0 where the acceleration jumps.
[[nodiscard]] double jerkAt(const Profile& profile, double t);

static_assert(__is_trivially_copyable(State) && __is_trivially_copyable(Limits));
static_assert(__is_trivially_copyable(Profile));

}  // namespace rung::motion
