// SPDX-License-Identifier: Apache-2.0
// Profiles whose figures follow from closed forms: the rows of the motion digest that are about profiles (T-A to T-V),
// the laws of the smooth ramps, starts beyond limits, and requests that are refused.
#include "stdlib/motion/profile/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>

namespace rung::motion {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = 3.14159265358979323846;

struct Point {
  double t, position, velocity;
};

Profile moved(const State& start, double position, double end_velocity, const Limits& limits, Ramp ramp) {
  Profile profile{};
  EXPECT_EQ(int(planPosition(profile, start, position, end_velocity, limits, ramp)), int(Result::Ok));
  return profile;
}
Profile moved(double distance, const Limits& limits, Ramp ramp) { return moved({}, distance, 0, limits, ramp); }

Profile run(const State& start, double velocity, const Limits& limits, Ramp ramp) {
  Profile profile{};
  EXPECT_EQ(int(planVelocity(profile, start, velocity, limits, ramp)), int(Result::Ok));
  return profile;
}

void expectPoints(const Profile& profile, std::initializer_list<Point> points) {
  for (const Point& point : points) {
    const State state = at(profile, point.t);
    EXPECT_NEAR(state.position, point.position, 1e-9) << "position at " << point.t;
    EXPECT_NEAR(state.velocity, point.velocity, 1e-9) << "velocity at " << point.t;
  }
}

double peakVelocity(const Profile& profile) {
  double peak = 0;
  for (int i = 0; i <= 100000; ++i)
    peak = std::fmax(peak, std::fabs(at(profile, duration(profile) * i / 100000).velocity));
  return peak;
}

TEST(Profile, ZeroBytesAreRest) {
  Profile profile;
  std::memset(static_cast<void*>(&profile), 0, sizeof profile);
  for (double t : {0.0, 1.0, 1e9}) {
    EXPECT_EQ(at(profile, t).position, 0);
    EXPECT_EQ(at(profile, t).velocity, 0);
    EXPECT_EQ(jerkAt(profile, t), 0);
  }
}

TEST(Profile, Trapezoid) {  // T-A1, T-B1
  const Profile a1 = moved(100, {10, 5, 5, 0}, Ramp::Trapezoid);
  EXPECT_NEAR(duration(a1), 12, 1e-12);
  expectPoints(a1, {{1, 2.5, 5}, {2, 10, 10}, {6, 50, 10}, {10, 90, 10}, {11, 97.5, 5}, {12, 100, 0}});
  const Profile b1 = moved(50, {3, 2, 100, 0}, Ramp::Trapezoid);
  EXPECT_NEAR(duration(b1), 1.5 + 47.705 / 3 + 0.03, 1e-9);
  expectPoints(b1, {{1, 1, 2}, {1.5, 2.25, 3}, {10, 27.75, 3}});
}

TEST(Profile, ShortTrapezoid) {  // T-A3, T-Q1
  const Profile a3 = moved(10, {100, 8, 2, 0}, Ramp::Trapezoid);
  EXPECT_NEAR(duration(a3), 3.535533906, 1e-9);
  expectPoints(a3, {{0.70710678118654757, 2, 5.656854249492380}});
  const Profile q1 = moved(5, {10, 10, 10, 0}, Ramp::Trapezoid);
  EXPECT_NEAR(duration(q1), std::sqrt(2), 1e-12);
  EXPECT_NEAR(peakVelocity(q1), 7.071067812, 1e-4);
}

TEST(Profile, QuadraticWithCruise) {  // T-D1
  const Profile d1 = moved(100, {10, 5, 5, 5}, Ramp::Quadratic);
  EXPECT_NEAR(duration(d1), 13, 1e-12);
  expectPoints(d1, {{1, 0.833333333333, 2.5}, {2, 5.833333333333, 7.5}, {3, 15, 10}, {10, 85, 10}, {13, 100, 0}});
  EXPECT_NEAR(at(d1, 1).acceleration, 5, 1e-12);
  EXPECT_EQ(jerkAt(d1, 0.5), 5);
  EXPECT_EQ(jerkAt(d1, 1.5), 0);
  EXPECT_EQ(jerkAt(d1, 2.5), -5);
}

TEST(Profile, QuadraticBelowTheAcceleration) {  // T-D2
  const Profile d2 = moved(2, {10, 5, 5, 6}, Ramp::Quadratic);
  const double tj = std::cbrt(2 / 12.0);
  EXPECT_NEAR(duration(d2), 4 * tj, 1e-12);
  EXPECT_NEAR(at(d2, tj).acceleration, 6 * tj, 1e-12);
  EXPECT_NEAR(at(d2, 2 * tj).velocity, 6 * tj * tj, 1e-12);
  EXPECT_NEAR(6 * tj * tj, 1.817120593, 1e-9);
}

TEST(Profile, QuadraticBelowTheVelocity) {  // T-D3
  const Profile d3 = moved(20, {100, 5, 5, 10}, Ramp::Quadratic);
  EXPECT_NEAR(duration(d3), 4.531128874, 1e-9);
  EXPECT_NEAR(at(d3, duration(d3) / 2).velocity, 8.827822185, 1e-9);
}

TEST(Profile, QuadraticWithoutJerkIsATrapezoid) {
  for (double jerk : {0.0, infinite}) {
    EXPECT_NEAR(duration(moved(100, {10, 5, 5, jerk}, Ramp::Quadratic)), 12, 1e-12);
  }
}

TEST(Profile, Sin2) {  // T-E1, T-E2
  const Profile e1 = moved(100, {10, 5, 5, 0}, Ramp::Sin2);
  EXPECT_NEAR(duration(e1), 13.141592654, 1e-9);
  expectPoints(e1, {{pi / 2, 2.853981633974, 5}, {pi, 15.707963267949, 10}, {duration(e1), 100, 0}});
  EXPECT_NEAR(at(e1, pi / 2).acceleration, 5, 1e-12);
  const Profile e2 = moved(10, {100, 5, 5, 0}, Ramp::Sin2);
  EXPECT_NEAR(duration(e2), 3.544907702, 1e-9);
  EXPECT_NEAR(at(e2, duration(e2) / 2).velocity, 5.641895835, 1e-9);
}

// v = v0 + dv * sin^2(pi s / 2) and the quintic, against libm and Horner.
TEST(Profile, LawsOfSmoothRamps) {
  const Profile sine = run({0, 2, 0}, 10, {0, 5, 5, 0}, Ramp::Sin2);
  EXPECT_NEAR(duration(sine), pi * 8 / 10, 1e-12);
  const Profile quintic = run({0, 2, 0}, 10, {0, 5, 5, 0}, Ramp::QuadraticSmooth);
  EXPECT_NEAR(duration(quintic), 15 * 8 / 40.0, 1e-12);
  for (int i = 0; i < 100; ++i) {
    const double s = i / 100.0;
    const State a = at(sine, s * duration(sine));
    const double root = std::sin(pi * s / 2);
    EXPECT_NEAR(a.velocity, 2 + 8 * root * root, 1e-14);
    EXPECT_NEAR(a.position, duration(sine) * (2 * s + 8 * (s / 2 - std::sin(pi * s) / (2 * pi))), 1e-13);
    EXPECT_NEAR(a.acceleration, 5 * std::sin(pi * s), 1e-14);
    EXPECT_NEAR(jerkAt(sine, s * duration(sine)), 5 * pi / duration(sine) * std::cos(pi * s), 1e-13);
    const State q = at(quintic, s * duration(quintic));
    EXPECT_NEAR(q.velocity, 2 + 8 * (10 * s * s * s - 15 * s * s * s * s + 6 * s * s * s * s * s), 1e-13);
    EXPECT_NEAR(q.acceleration, 8 / 3.0 * 30 * (s * s - 2 * s * s * s + s * s * s * s), 1e-13);
    EXPECT_NEAR(jerkAt(quintic, s * duration(quintic)), 8 / 9.0 * (60 * s - 180 * s * s + 120 * s * s * s), 1e-12);
  }
  EXPECT_NEAR(peakVelocity(moved(1, {100, 5, 5, 0}, Ramp::QuadraticSmooth)), std::sqrt(8 * 5 * 1 / 15.0), 1e-9);
}

TEST(Profile, RunningStartOfTheFastestDirection) {  // T-F4: 350 forward or 10 back, running at 50
  const Limits limits{50, 10, 10, 0};
  EXPECT_NEAR(duration(moved({0, 50, 0}, 350, 0, limits, Ramp::Trapezoid)), 9.5, 1e-9);
  EXPECT_NEAR(duration(moved({0, 50, 0}, -10, 0, limits, Ramp::Trapezoid)), 12.348469228, 1e-9);
}

TEST(Profile, NewTargetInMotion) {  // T-G1, T-G2, T-G3
  const Limits limits{10, 10, 10, 0};
  const State running = at(moved(100, limits, Ramp::Trapezoid), 5);
  EXPECT_NEAR(running.position, 45, 1e-12);
  EXPECT_NEAR(5 + duration(moved(running, 150, 0, limits, Ramp::Trapezoid)), 16, 1e-12);
  EXPECT_NEAR(5 + duration(moved(running, 95, 0, limits, Ramp::Trapezoid)), 10.5, 1e-12);
  const Profile back = moved(running, 20, 0, limits, Ramp::Trapezoid);
  EXPECT_NEAR(duration(back), 5, 1e-12);
  expectPoints(back, {{1, 50, 0}, {5, 20, 0}});
}

TEST(Profile, Halt) {  // T-H1, T-H2
  const Profile h1 = run({0, 10, 0}, 0, {0, 5, 5, 0}, Ramp::Trapezoid);
  EXPECT_NEAR(duration(h1), 2, 1e-12);
  EXPECT_NEAR(at(h1, 2).position, 10, 1e-12);
  const Profile h2 = run({0, 10, 0}, 0, {0, 5, 5, 5}, Ramp::Quadratic);
  EXPECT_NEAR(duration(h2), 3, 1e-12);
  EXPECT_NEAR(at(h2, 3).position, 15, 1e-12);
}

TEST(Profile, Velocity) {  // T-I1, T-I2
  const Limits limits{0, 4, 10, 0};
  const Profile i1 = run({}, 20, limits, Ramp::Trapezoid);
  EXPECT_NEAR(duration(i1), 5, 1e-12);
  expectPoints(i1, {{5, 50, 20}, {7, 90, 20}});
  const Profile i2 = run({0, 20, 0}, -20, limits, Ramp::Trapezoid);
  EXPECT_NEAR(duration(i2), 7, 1e-12);
  expectPoints(i2, {{2, 20, 0}, {7, -30, -20}});
}

TEST(Profile, SuperimposedBase) {  // T-J1, T-R1, T-S1, T-S2
  EXPECT_NEAR(duration(moved(10, {5, 5, 5, 0}, Ramp::Trapezoid)), 3, 1e-12);
  EXPECT_NEAR(at(run({}, 10, {0, 5, 10, 0}, Ramp::Trapezoid), 3).position, 20, 1e-12);
  EXPECT_NEAR(duration(run({20, 10, 0}, 0, {0, 5, 10, 0}, Ramp::Trapezoid)), 1, 1e-12);
  // Half the velocity at t = 5: 5 is reached at 5.5 s and 48.75, arrival at 16 s.
  const Profile half = moved({45, 10, 0}, 100, 0, {5, 10, 10, 0}, Ramp::Trapezoid);
  expectPoints(half, {{0.5, 48.75, 5}});
  EXPECT_NEAR(5 + duration(half), 16, 1e-12);
}

TEST(Profile, EndVelocity) {  // T-V1
  const Limits limits{10, 10, 10, 0};
  Profile v1{};
  ASSERT_EQ(int(planContinuous(v1, {}, 100, 5, limits, Ramp::Trapezoid)), int(Result::Ok));
  EXPECT_NEAR(duration(v1), 10.625, 1e-12);
  expectPoints(v1, {{10.625, 100, 5}, {12.625, 110, 5}});
}

// 5 u/s needs 1.25 u: the target is crossed with what is reached, sqrt(2 * 10 * 1) u/s.
TEST(Profile, EndVelocityAfterTheTarget) {
  const Limits limits{10, 10, 10, 0};
  Profile profile{};
  ASSERT_EQ(int(planContinuous(profile, {}, 1, 5, limits, Ramp::Trapezoid)), int(Result::Ok));
  EXPECT_NEAR(duration(profile), 0.5, 1e-12);
  expectPoints(profile, {{std::sqrt(0.2), 1, std::sqrt(20)}, {0.5, 1.25, 5}});
  // Too fast to be slow enough at the target: it is crossed while the axis slows down.
  ASSERT_EQ(int(planContinuous(profile, {0, 10, 0}, 1, 2, limits, Ramp::Trapezoid)), int(Result::Ok));
  EXPECT_NEAR(duration(profile), 0.8, 1e-12);
  EXPECT_NEAR(at(profile, 0.8).position, 4.8, 1e-12);
  // Against the direction of the end velocity there is no other way than to turn.
  ASSERT_EQ(int(planContinuous(profile, {}, -1, 5, limits, Ramp::Trapezoid)), int(Result::Ok));
  EXPECT_EQ(at(profile, duration(profile)).position, -1);
  EXPECT_EQ(at(profile, duration(profile)).velocity, 5);
  double lowest = 0;
  for (int i = 0; i < 1000; ++i) lowest = std::fmin(lowest, at(profile, duration(profile) * i / 1000).position);
  EXPECT_NEAR(lowest, -2.25, 1e-3);
}

// The exact plan of the same request backs up first.
TEST(Profile, EndVelocityAtTheTargetExactly) {
  const Profile profile = moved({}, 1, 5, {10, 10, 10, 0}, Ramp::Trapezoid);
  EXPECT_EQ(at(profile, duration(profile)).position, 1);
  EXPECT_EQ(at(profile, duration(profile)).velocity, 5);
  EXPECT_LT(at(profile, 0.1).position, 0);
}

TEST(Profile, AccelerationAndDecelerationDifferWithJerk) {
  // Up: 0.5 s jerk to 5, then constant, 0.5 s to 0; down with 2 in place of 5.
  const Profile profile = moved(100, {10, 5, 2, 10}, Ramp::Quadratic);
  const double up = 10 / 5.0 + 5 / 10.0;
  const double down = 10 / 2.0 + 2 / 10.0;
  EXPECT_NEAR(duration(profile), up + down + (100 - 5 * up - 5 * down) / 10, 1e-12);
}

// Through velocity 0 the limit changes: from 4 while braking to 1 while going on, or back.
TEST(Profile, LimitChangesAtVelocityZero) {
  const Profile lower = run({0, -10, 0}, 10, {0, 1, 4, 2}, Ramp::Quadratic);
  double t = 0;
  for (int i = 0; i < lower.phase_count; ++i) {
    const State state = at(lower, t);
    if (std::fabs(state.velocity) < 1e-9) {
      EXPECT_NEAR(state.acceleration, 1, 1e-9);
    }
    t += lower.phases[i].duration;
  }
  // Braking: 2 s up to 4, the acceleration falls from 4 to 1 in 1.5 s; then 1, and 0.5 s to 0.
  const double braking = 2 + (10 - 4 - 3.75) / 4 + 1.5;
  const double going = (10 - 0.25) / 1 + 0.5;
  EXPECT_NEAR(duration(lower), braking + going, 1e-9);
  // Backwards in time it is the other way round.
  EXPECT_NEAR(duration(run({0, -10, 0}, 10, {0, 4, 1, 2}, Ramp::Quadratic)), braking + going, 1e-9);
}

TEST(Profile, StartAccelerationCounts) {
  // From a = 5 at v = 5 the acceleration goes to 0 in 1 s: 2.5 u/s more.
  const Profile profile = run({0, 5, 5}, 7.5, {0, 5, 5, 5}, Ramp::Quadratic);
  EXPECT_NEAR(duration(profile), 1, 1e-12);
  EXPECT_NEAR(at(profile, 1).position, 5 + 2.5 - 5 / 6.0, 1e-12);
  // A trapezoid may jump.
  EXPECT_NEAR(duration(run({0, 5, 5}, 7.5, {0, 5, 5, 5}, Ramp::Trapezoid)), 0.5, 1e-12);
}

TEST(Profile, StartBeyondTheVelocityGoesBackAtOnce) {
  for (Ramp ramp : {Ramp::Trapezoid, Ramp::Sin2, Ramp::Quadratic, Ramp::QuadraticSmooth}) {
    const Profile profile = moved({0, 20, 0}, 1000, 0, {10, 5, 5, 5}, ramp);
    double last = 20;
    double t = 0;
    while (at(profile, t).velocity > 10) {
      EXPECT_LE(at(profile, t).velocity, last);
      last = at(profile, t).velocity;
      t += 0.01;
      ASSERT_LT(t, 10);
    }
    for (; t < duration(profile); t += 0.01) EXPECT_LE(at(profile, t).velocity, 10);
  }
}

TEST(Profile, StartBeyondTheAccelerationGoesBackAtOnce) {
  const Profile profile = moved({0, 0, 20}, 1000, 0, {100, 5, 5, 10}, Ramp::Quadratic);
  EXPECT_NEAR(at(profile, 1).acceleration, 10, 1e-12);
  EXPECT_NEAR(at(profile, 1.5).acceleration, 5, 1e-12);
  EXPECT_NEAR(at(profile, 2).acceleration, 5, 1e-12);
}

TEST(Profile, NoDistance) {
  for (Ramp ramp : {Ramp::Trapezoid, Ramp::Sin2, Ramp::Quadratic, Ramp::QuadraticSmooth}) {
    const Profile profile = moved({3, 0, 0}, 3, 0, {10, 5, 5, 5}, ramp);
    EXPECT_EQ(duration(profile), 0);
    EXPECT_EQ(at(profile, 0).position, 3);
    EXPECT_EQ(at(profile, 1).position, 3);
  }
}

TEST(Profile, TinyAndHuge) {
  for (Ramp ramp : {Ramp::Trapezoid, Ramp::Sin2, Ramp::Quadratic, Ramp::QuadraticSmooth}) {
    for (double distance : {1e-12, 1e12, -1e-12, -1e12}) {
      const Profile profile = moved(distance, {10, 5, 5, 5}, ramp);
      EXPECT_EQ(at(profile, duration(profile)).position, distance);
      EXPECT_EQ(at(profile, duration(profile)).velocity, 0);
      EXPECT_NEAR(at(profile, duration(profile) / 2).position, distance / 2, std::fabs(distance) * 1e-9);
    }
  }
}

TEST(Profile, EvaluationOutsideOfTheTime) {
  const Profile profile = moved({1, 2, 0}, 100, 5, {10, 5, 5, 5}, Ramp::Quadratic);
  EXPECT_EQ(at(profile, -1).position, 1);
  EXPECT_EQ(at(profile, 0).velocity, 2);
  EXPECT_EQ(at(profile, duration(profile)).position, 100);
  EXPECT_EQ(at(profile, duration(profile)).velocity, 5);
  EXPECT_NEAR(at(profile, duration(profile) + 1e6).position, 100 + 5e6, 1e-6);
}

TEST(Profile, RefusesWhatIsNotFinite) {
  Profile profile{};
  profile.end_position = 42;
  const Limits limits{10, 5, 5, 5};
  for (double bad : {nan, infinite, -infinite}) {
    for (Ramp ramp : {Ramp::Trapezoid, Ramp::Quadratic}) {
      EXPECT_EQ(int(planPosition(profile, {bad, 0, 0}, 1, 0, limits, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planPosition(profile, {0, bad, 0}, 1, 0, limits, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planPosition(profile, {0, 0, bad}, 1, 0, limits, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planPosition(profile, {}, bad, 0, limits, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planPosition(profile, {}, 1, bad, limits, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planPosition(profile, {}, 1, 0, {bad, 5, 5, 5}, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planPosition(profile, {}, 1, 0, {10, bad, 5, 5}, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planPosition(profile, {}, 1, 0, {10, 5, bad, 5}, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planVelocity(profile, {}, bad, limits, ramp)), int(Result::NotFinite));
      EXPECT_EQ(int(planContinuous(profile, {}, bad, 0, limits, ramp)), int(Result::NotFinite));
    }
  }
  EXPECT_EQ(int(planPosition(profile, {}, 1, 0, {10, 5, 5, nan}, Ramp::Quadratic)), int(Result::NotFinite));
  EXPECT_EQ(profile.end_position, 42) << "a refused request leaves the profile";
}

TEST(Profile, RefusesBadLimits) {
  Profile profile{};
  for (double bad : {0.0, -1.0}) {
    EXPECT_EQ(int(planPosition(profile, {}, 1, 0, {bad, 5, 5, 5}, Ramp::Quadratic)), int(Result::BadLimits));
    EXPECT_EQ(int(planPosition(profile, {}, 1, 0, {10, bad, 5, 5}, Ramp::Quadratic)), int(Result::BadLimits));
    EXPECT_EQ(int(planPosition(profile, {}, 1, 0, {10, 5, bad, 5}, Ramp::Quadratic)), int(Result::BadLimits));
    EXPECT_EQ(int(planVelocity(profile, {}, 1, {10, bad, 5, 5}, Ramp::Quadratic)), int(Result::BadLimits));
  }
  EXPECT_EQ(int(planPosition(profile, {}, 1, 0, {10, 5, 5, -1}, Ramp::Quadratic)), int(Result::BadLimits));
  EXPECT_EQ(int(planPosition(profile, {}, 1, 11, {10, 5, 5, 0}, Ramp::Trapezoid)), int(Result::EndVelocityTooHigh));
  EXPECT_EQ(int(planPosition(profile, {}, 1e300, 0, {1e-300, 5, 5, 0}, Ramp::Trapezoid)), int(Result::OutOfRange));
}

}  // namespace
}  // namespace rung::motion
