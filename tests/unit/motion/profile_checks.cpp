// SPDX-License-Identifier: Apache-2.0
// See profile_checks.h.
#include "tests/unit/motion/profile_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

namespace rung::motion {
namespace {

constexpr double ulp = 2.220446049250313e-16;

struct Allowed {
  double speed, growing, falling;
};

// What a start beyond a limit brings along cannot be below the limit at once.
Allowed allowedOf(const Request& request) {
  const State& start = request.start;
  const Limits& limits = request.limits;
  Allowed allowed{limits.velocity, limits.acceleration, limits.deceleration};
  if (!request.to_position) allowed.speed = std::max(std::fabs(start.velocity), std::fabs(request.end_velocity));
  allowed.speed = std::max(allowed.speed, std::fabs(start.velocity));
  if (!request.isJerkLimited()) return allowed;
  const double a = start.acceleration;
  allowed.speed = std::max(allowed.speed, std::fabs(start.velocity + a * std::fabs(a) / (2 * limits.jerk)));
  if (a * start.velocity >= 0) {
    allowed.growing = std::max(allowed.growing, std::fabs(a));
  } else {
    allowed.falling = std::max(allowed.falling, std::fabs(a));
    // Braking that must go through velocity 0 with some of its acceleration.
    const double at_zero = a * a - 2 * limits.jerk * std::fabs(start.velocity);
    if (at_zero > 0) allowed.growing = std::max(allowed.growing, std::sqrt(at_zero));
  }
  return allowed;
}

// The greatest speed where a phase begins.
double speedOf(const Profile& profile) {
  double speed = std::fabs(profile.end_velocity);
  double t = 0;
  for (int i = 0; i < profile.phase_count; ++i) {
    speed = std::max(speed, std::fabs(at(profile, t).velocity));
    t += profile.phases[i].duration;
  }
  return speed;
}

double smoothPeak(Ramp ramp, double mean) {
  if (ramp == Ramp::Sin2) return mean * 3.14159265358979323846 / 2;
  return ramp == Ramp::QuadraticSmooth ? mean * 15 / 8 : mean;
}

}  // namespace

Result plan(Profile& profile, const Request& r) {
  return r.to_position ? planPosition(profile, r.start, r.position, r.end_velocity, r.limits, r.ramp)
                       : planVelocity(profile, r.start, r.end_velocity, r.limits, r.ramp);
}

void Peaks::take(State& s, double duration, double jerk) {
  // The limit changes at velocity 0: beside it the rounding of the velocity decides.
  const double end_speed = std::fabs(s.velocity + duration * (s.acceleration + duration * jerk / 2));
  const double near_zero = 1e-12 * std::max({speed, std::fabs(s.velocity), end_speed});
  const auto sideOf = [&](double v, double a) {
    if (std::fabs(v) <= near_zero) return;
    if (v * a > 0) growing = std::max(growing, std::fabs(a));
    if (v * a < 0) falling = std::max(falling, std::fabs(a));
  };
  // Where the velocity or the acceleration changes its sign.
  double stops[5] = {0, duration, duration, duration, duration};
  int count = 2;
  const auto stopAt = [&](double t) {
    if (t > 0 && t < duration) stops[count++] = t;
  };
  if (jerk != 0) {
    stopAt(-s.acceleration / jerk);
    const double root = s.acceleration * s.acceleration - 2 * jerk * s.velocity;
    if (root >= 0) {
      // Without the difference of nearly equal numbers.
      const double q = -(s.acceleration + (s.acceleration < 0 ? -1 : 1) * std::sqrt(root));
      if (q != 0) stopAt(2 * s.velocity / q);
      stopAt(q / jerk);
    }
  } else if (s.acceleration != 0) {
    stopAt(-s.velocity / s.acceleration);
  }
  std::sort(stops, stops + count);
  State from = s;
  for (int i = 1; i < count; ++i) {
    const double t = stops[i];
    const State to{s.position + t * (s.velocity + t * (s.acceleration / 2 + t * jerk / 6)),
                   s.velocity + t * (s.acceleration + t * jerk / 2), s.acceleration + t * jerk};
    const double middle = (stops[i - 1] + t) / 2;
    const double v = s.velocity + middle * (s.acceleration + middle * jerk / 2);
    if (stops[i - 1] < t) {
      sideOf(v, from.acceleration);
      sideOf(v, to.acceleration);
    }
    speed = std::max({speed, std::fabs(from.velocity), std::fabs(to.velocity)});
    path += std::fabs(to.position - from.position);
    from = to;
  }
  s = from;
}

std::string print(const Request& r) {
  char line[400];
  std::snprintf(
      line, sizeof line, "%s ramp %d: start {%.17g, %.17g, %.17g} to %.17g, %.17g limits {%.17g, %.17g, %.17g, %.17g}",
      r.to_position ? "position" : "velocity", int(r.ramp), r.start.position, r.start.velocity, r.start.acceleration,
      r.position, r.end_velocity, r.limits.velocity, r.limits.acceleration, r.limits.deceleration, r.limits.jerk);
  return line;
}

std::string violation(const Profile& profile, const Request& request) {
  char out[200];
  const auto fail = [&](const char* what, double value, double expected) {
    std::snprintf(out, sizeof out, "%s: %.17g, expected %.17g", what, value, expected);
    return std::string(out);
  };
  if (profile.phase_count > Profile::max_phases) return fail("phases", profile.phase_count, Profile::max_phases);
  const Allowed allowed = allowedOf(request);
  const bool jerk_limited = request.isJerkLimited();
  const double steepest = std::max({allowed.growing, allowed.falling, std::fabs(request.start.acceleration)});
  // Forwards to the seam, as at() does; the phases after it start from states that are counted from the end.
  Peaks peaks;
  State state = request.start;
  double duration = 0;
  peaks.speed = speedOf(profile);
  State back[Profile::max_phases + 1];
  back[profile.phase_count] = {profile.end_position, profile.end_velocity, 0};
  for (int i = profile.phase_count - 1; i >= profile.seam; --i) {
    const Phase& phase = profile.phases[i];
    const double t = phase.duration;
    const double a = phase.acceleration + phase.jerk * t;
    back[i] = {back[i + 1].position - t * (back[i + 1].velocity - t * (a / 2 - t * phase.jerk / 6)),
               back[i + 1].velocity - t * (a - t * phase.jerk / 2), phase.acceleration};
  }
  State seam_before = request.start;
  for (int i = 0; i < profile.phase_count; ++i) {
    const Phase& phase = profile.phases[i];
    if (!(phase.duration > 0)) return fail("duration of a phase", phase.duration, 0);
    if (phase.jerk != 0 && !(std::fabs(phase.jerk) <= request.limits.jerk * (1 + 1e-12))) {
      return fail("jerk", phase.jerk, request.limits.jerk);
    }
    if (i == profile.seam) {
      seam_before = state;
      state = back[i];
      state.acceleration = seam_before.acceleration;
    }
    if (jerk_limited && !(std::fabs(phase.acceleration - state.acceleration) <= 1e-11 * steepest)) {
      return fail("jump of the acceleration", phase.acceleration, state.acceleration);
    }
    state.acceleration = phase.acceleration;
    const bool cruise = phase.acceleration == 0 && phase.jerk == 0;
    if (cruise && !(std::fabs(profile.cruise - state.velocity) <= 1e-12 * (peaks.speed + std::fabs(profile.cruise)))) {
      return fail("jump of the velocity", profile.cruise, state.velocity);
    }
    if (cruise) state.velocity = profile.cruise;
    peaks.take(state, phase.duration, phase.jerk);
    duration += phase.duration;
  }
  if (profile.seam == profile.phase_count) seam_before = state;
  if (!(std::fabs(duration - profile.duration) <= 4 * ulp * duration))
    return fail("duration", profile.duration, duration);

  const double growing = smoothPeak(request.ramp, peaks.growing);
  const double falling = smoothPeak(request.ramp, peaks.falling);
  if (!(peaks.speed <= allowed.speed * (1 + 1e-12))) return fail("speed", peaks.speed, allowed.speed);
  // A limit that changes at velocity 0 is met within the rounding of the velocity there.
  const bool changes = jerk_limited && request.limits.acceleration != request.limits.deceleration;
  const double bits = changes ? 2 * request.limits.jerk * 100 * ulp * peaks.speed : 0;
  const auto within = [&](double found, double limit) { return found * found <= limit * limit * (1 + 2e-12) + bits; };
  if (!within(growing, allowed.growing)) return fail("acceleration", growing, allowed.growing);
  if (!within(falling, allowed.falling)) return fail("deceleration", falling, allowed.falling);

  const State& seam_after = back[profile.seam];
  const State end = at(profile, profile.duration);
  const double scale = peaks.path + std::max(std::fabs(request.start.position), std::fabs(end.position));
  // At speed, the last bit of a velocity takes a time to reach, and the axis covers a distance in that time.
  const double smaller = std::min(request.limits.acceleration, request.limits.deceleration);
  double position_slack = 1e-13 * peaks.path + 200 * ulp * scale;
  if (request.end_velocity != 0) {
    const double peak =
        jerk_limited ? std::min(smaller, std::sqrt(request.limits.jerk * peaks.speed * 1e-11)) : smaller;
    position_slack += 100 * ulp * peaks.speed * peaks.speed / peak;
  }
  if (request.to_position && end.position != request.position) return fail("end", end.position, request.position);
  if (end.velocity != request.end_velocity) return fail("end velocity", end.velocity, request.end_velocity);
  if (!(std::fabs(seam_before.position - seam_after.position) <= position_slack)) {
    return fail("seam", seam_before.position, seam_after.position);
  }
  if (!(std::fabs(seam_before.velocity - seam_after.velocity) <= 1e-12 * peaks.speed)) {
    return fail("velocity at the seam", seam_before.velocity, seam_after.velocity);
  }
  if (jerk_limited && !(std::fabs(state.acceleration) <= 1e-11 * steepest)) {
    return fail("acceleration at the end", state.acceleration, 0);
  }
  return {};
}

double Random::uniform(double low, double high) { return low + (high - low) * (double(next() >> 11) * 0x1p-53); }
double Random::magnitude(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

uint64_t Random::next() {
  uint64_t z = (state_ += 0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace rung::motion
