// SPDX-License-Identifier: Apache-2.0
// Random profiles: limits, continuity and exact arrival, also after interruptions and with values of any magnitude; and
// time-optimality against random motions that keep the same limits. The seed is fixed; RUNG_PROFILE_SEED and
// RUNG_PROFILE_COUNT try others (tools/long.sh profiles).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/unit/motion/profile_checks.h"

namespace rung::motion {
namespace {

uint64_t fromEnvironment(const char* name, uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}
uint64_t seed() { return fromEnvironment("RUNG_PROFILE_SEED", 1); }
long count() { return long(fromEnvironment("RUNG_PROFILE_COUNT", 20000)); }

constexpr int max_reports = 5;

// `spread`: how many times the greatest limit may be the smallest.
Limits randomLimits(Random& random, double spread) {
  const double low = 1 / std::sqrt(spread);
  const double high = std::sqrt(spread);
  Limits limits{random.magnitude(low, high), random.magnitude(low, high), 0, random.magnitude(low, high)};
  limits.deceleration = random.chance(0.3) ? limits.acceleration : random.magnitude(low, high);
  return limits;
}

double edgeOr(Random& random, double limit) {
  switch (random.below(8)) {
    case 0: return 0;
    case 1: return limit;
    case 2: return -limit;
    case 3: return limit * (1 - 1e-15);
    default: return random.uniform(-1, 1) * limit;
  }
}

void aim(Random& random, Request& r) {
  const Limits& l = r.limits;
  r.to_position = !random.chance(0.2);
  r.end_velocity = random.chance(0.5) ? 0 : edgeOr(random, l.velocity);
  const double least =
      l.velocity / std::min(l.acceleration, l.deceleration) + (r.isJerkLimited() ? l.acceleration / l.jerk : 0);
  const double distance = l.velocity * least * random.magnitude(1e-4, 1e2);
  switch (random.below(10)) {
    case 0: r.position = r.start.position; break;
    case 1: r.position = r.start.position + random.sign() * 1e-12; break;
    case 2: r.position = r.start.position + random.sign() * 1e-6 * distance; break;
    default: r.position = r.start.position + random.sign() * distance; break;
  }
}

Request randomRequest(Random& random, double spread) {
  Request r;
  const int kind = random.below(10);
  r.ramp = kind < 7 ? Ramp::Quadratic : kind < 8 ? Ramp::Trapezoid : kind < 9 ? Ramp::Sin2 : Ramp::QuadraticSmooth;
  r.limits = randomLimits(random, spread);
  r.start.position = random.chance(0.3) ? 0 : random.uniform(-1, 1) * r.limits.velocity * random.magnitude(1e-3, 1e3);
  const double beyond = random.chance(0.1) ? 3 : 1;
  r.start.velocity = edgeOr(random, r.limits.velocity) * beyond;
  if (r.isJerkLimited()) {
    const bool up = random.chance(0.5);
    r.start.acceleration = edgeOr(random, up ? r.limits.acceleration : r.limits.deceleration) * beyond;
  }
  aim(random, r);
  return r;
}

// Tells whether the start is beyond a limit of the velocity, or will be.
bool isBeyond(const Request& r) {
  const double a = r.start.acceleration;
  const double rest = r.start.velocity + (r.isJerkLimited() ? a * std::fabs(a) / (2 * r.limits.jerk) : 0);
  return std::max(std::fabs(r.start.velocity), std::fabs(rest)) > r.limits.velocity;
}

// Returns whether the profile holds what it must.
bool holds(const Request& request, Profile& profile) {
  const Result result = plan(profile, request);
  EXPECT_EQ(int(result), int(Result::Ok)) << print(request);
  if (result != Result::Ok) return false;
  const std::string found = violation(profile, request);
  EXPECT_EQ(found, "") << print(request);
  return found.empty();
}

void checkMany(double spread, uint64_t first) {
  Random random(first);
  int reports = 0;
  for (long i = 0; i < count() && reports < max_reports; ++i) {
    Profile profile;
    if (!holds(randomRequest(random, spread), profile)) ++reports;
  }
}

TEST(ProfileProperties, UsualLimits) { checkMany(1e2, seed()); }
TEST(ProfileProperties, LimitsFarApart) { checkMany(1e9, seed() + 1000); }

// Numbers of any magnitude: a plan whose figures are finite and which arrives, or a refusal.
TEST(ProfileProperties, AnyNumbers) {
  Random random(seed() + 5000);
  int reports = 0;
  long planned = 0;
  for (long i = 0; i < count() && reports < max_reports; ++i) {
    const double most = random.chance(0.1) ? 1e300 : 1e29;
    const auto any = [&] { return random.chance(0.1) ? 0 : random.sign() * random.magnitude(1 / most, most); };
    Request r;
    r.start = {any(), any(), any()};
    r.position = any();
    r.end_velocity = any();
    r.limits = {std::fabs(any()), std::fabs(any()), std::fabs(any()), std::fabs(any())};
    r.ramp = Ramp(random.below(4));
    Profile profile;
    const Result result = plan(profile, r);
    EXPECT_NE(int(result), int(Result::NotFinite)) << print(r);
    if (result != Result::Ok) continue;
    ++planned;
    bool finite = std::isfinite(duration(profile)) && duration(profile) >= 0;
    for (int k = 0; k <= 10; ++k) {
      const State state = at(profile, duration(profile) * k / 10);
      finite =
          finite && std::isfinite(state.position) && std::isfinite(state.velocity) && std::isfinite(state.acceleration);
    }
    const State end = at(profile, duration(profile));
    if (!finite || end.position != r.position || end.velocity != r.end_velocity) {
      ADD_FAILURE() << print(r);
      ++reports;
    }
  }
  EXPECT_GT(planned, count() / 100);
}

// Continuous moves arrive at the target, or cross it once in the direction of the end velocity and go on to that.
TEST(ProfileProperties, ContinuousMoves) {
  Random random(seed() + 6000);
  int reports = 0;
  for (long i = 0; i < count() && reports < max_reports; ++i) {
    Request r = randomRequest(random, 1e2);
    r.to_position = true;
    Profile profile;
    ASSERT_EQ(int(planContinuous(profile, r.start, r.position, r.end_velocity, r.limits, r.ramp)), int(Result::Ok));
    const double end = at(profile, duration(profile)).position;
    const bool ahead = (r.position - r.start.position) * r.end_velocity > 0 && r.start.velocity * r.end_velocity > 0;
    if (end == r.position && ahead && r.start.acceleration == 0 && !isBeyond(r)) {
      // Given again on the way, the command leads there again.
      Request again = r;
      again.start = at(profile, random.uniform(0, 1) * duration(profile));
      Profile rest;
      const bool resumes = again.ramp == Ramp::Trapezoid || again.ramp == Ramp::Quadratic;
      ASSERT_EQ(int(planContinuous(rest, again.start, r.position, r.end_velocity, r.limits, r.ramp)), int(Result::Ok));
      const double there = at(rest, duration(rest)).position;
      const double scale = std::fabs(r.position) + std::fabs(r.start.position) + r.limits.velocity * duration(profile);
      if (resumes && std::fabs(there - r.position) > 1e-9 * scale) {
        ADD_FAILURE() << print(again);
        ++reports;
      }
    }
    if (end != r.position) {
      const bool crossed =
          (end - r.position) * r.end_velocity > 0 && (r.position - r.start.position) * r.end_velocity >= 0;
      EXPECT_TRUE(crossed) << print(r);
      r.to_position = false;
    }
    const std::string found = violation(profile, r);
    EXPECT_EQ(found, "") << print(r);
    reports += found.empty() ? 0 : 1;
  }
}

// Five commands in a row, each from where the one before is.
TEST(ProfileProperties, Interruptions) {
  Random random(seed() + 2000);
  int reports = 0;
  for (long i = 0; i < count() / 5 && reports < max_reports; ++i) {
    Request request = randomRequest(random, 1e3);
    for (int command = 0; command < 5; ++command) {
      Profile profile;
      if (!holds(request, profile)) {
        ++reports;
        break;
      }
      request.start = at(profile, random.uniform(0, 1.1) * duration(profile));
      if (random.chance(0.5)) {
        const Limits old = request.limits;
        request.limits = randomLimits(random, 1e3);
        if (random.chance(0.5)) request.limits.jerk = old.jerk;
      }
      aim(random, request);
    }
  }
}

// The same command again in mid-motion does not change the arrival.
TEST(ProfileProperties, SameCommandAgain) {
  Random random(seed() + 3000);
  int reports = 0;
  for (long i = 0; i < count() && reports < max_reports; ++i) {
    Request request = randomRequest(random, 1e2);
    if (request.ramp == Ramp::Sin2 || request.ramp == Ramp::QuadraticSmooth) continue;  // a new ramp begins
    if (isBeyond(request)) continue;
    Profile profile;
    if (plan(profile, request) != Result::Ok) continue;
    const double t = random.uniform(0, 1) * duration(profile);
    request.start = at(profile, t);
    Profile rest;
    ASSERT_EQ(int(plan(rest, request)), int(Result::Ok)) << print(request);
    // An error e of the position costs a time of the order of the cube root of e / jerk where the axis has to stop and
    // go back for it, one of the velocity a time of the order of the square root.
    const double position_error = 1e-14 * (std::fabs(request.position) + std::fabs(request.start.position));
    const double velocity_error = 1e-15 * request.limits.velocity;
    const double jerk = request.limits.jerk;
    const double slack =
        1e-9 * duration(profile) + 4 * std::sqrt(velocity_error / jerk) + std::cbrt(32 * position_error / jerk);
    if (std::fabs(t + duration(rest) - duration(profile)) > slack) {
      ADD_FAILURE() << print(request) << ": " << t << " + " << duration(rest) << " is not " << duration(profile);
      ++reports;
    }
  }
}

struct Rival {
  Request request;
  double duration;
};

// A random motion with few phases; its own extremes are the limits of the request, so that it keeps them. With
// trapezoids the acceleration jumps, otherwise the jerk does.
Rival randomRival(Random& random, bool jerk_limited) {
  Rival rival{{}, 0};
  Request& r = rival.request;
  r.ramp = jerk_limited ? Ramp::Quadratic : Ramp::Trapezoid;
  r.start = {random.uniform(-1, 1), random.chance(0.3) ? 0 : random.uniform(-3, 3),
             jerk_limited && random.chance(0.6) ? random.uniform(-3, 3) : 0};
  const double jerk = jerk_limited ? random.magnitude(0.3, 3) : 0;
  Peaks peaks;
  State s = r.start;
  const double low = random.magnitude(0.3, 3);
  const double high = random.magnitude(0.3, 3);
  const int phases = 1 + random.below(7);
  for (int i = 0; i < phases; ++i) {
    const double t = random.magnitude(0.05, 3);
    const int choice = random.below(3) - 1;
    if (!jerk_limited) s.acceleration = choice * (s.velocity * choice >= 0 ? low : high);
    // A stretch of a trapezoid ends at velocity 0, where its limit may change.
    double length = t;
    if (!jerk_limited && s.velocity * s.acceleration < 0) length = std::min(t, -s.velocity / s.acceleration);
    peaks.take(s, length, choice * jerk);
    rival.duration += length;
  }
  if (jerk_limited && s.acceleration != 0) {
    const double t = std::fabs(s.acceleration) / jerk;
    peaks.take(s, t, s.acceleration > 0 ? -jerk : jerk);
    rival.duration += t;
  }
  r.position = s.position;
  r.end_velocity = s.velocity;
  r.limits = {peaks.speed, peaks.growing, peaks.falling, jerk};
  // A motion that only speeds up or only slows down says nothing of the other limit.
  const double nothing = 1e-9;  // what rounding leaves at velocity 0
  if (r.limits.acceleration < nothing) r.limits.acceleration = random.magnitude(0.3, 3);
  if (r.limits.deceleration < nothing) r.limits.deceleration = random.magnitude(0.3, 3);
  r.to_position = random.chance(0.9);
  return rival;
}

TEST(ProfileProperties, NoRandomMotionIsFaster) {
  Random random(seed() + 4000);
  int reports = 0;
  for (long i = 0; i < count() && reports < max_reports; ++i) {
    const Rival rival = randomRival(random, !random.chance(0.2));
    if (rival.request.limits.velocity == 0) continue;
    Profile profile;
    if (!holds(rival.request, profile)) {
      ++reports;
      continue;
    }
    // Where the acceleration gets to 0 at the end velocity but for a last bit, that takes a time of its own.
    const State& start = rival.request.start;
    const double jerk = rival.request.limits.jerk;
    double slack = 1e-9;
    if (jerk > 0 && start.acceleration != 0) {
      const double part = start.acceleration * start.acceleration / (2 * jerk);
      const double rest = start.velocity + (start.acceleration > 0 ? part : -part);
      const double bits = 1e-13 * (part + std::fabs(start.velocity));
      if (std::fabs(rest - rival.request.end_velocity) < bits) slack += 4 * std::sqrt(bits / jerk);
    }
    if (duration(profile) > rival.duration * (1 + 1e-9) + slack) {
      ADD_FAILURE() << print(rival.request) << ": " << duration(profile) << " instead of " << rival.duration;
      ++reports;
    }
  }
}

}  // namespace
}  // namespace rung::motion
