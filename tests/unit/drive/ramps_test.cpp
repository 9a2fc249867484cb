// SPDX-License-Identifier: Apache-2.0
// Ramps of the drive's own generators against hand-computed motions.
#include "drive/ramps.h"

#include <gtest/gtest.h>

namespace rung::motion {
namespace {

TEST(Ramps, VelocityRampInOneStepAndInParts) {
  // 0 to 10 with 5/s²: after 1 s 2.5 and 5, after 2 s 10 and 10, then steady.
  MotionPoint at = rampVelocity({0, 0}, 10, 5, 1);
  EXPECT_DOUBLE_EQ(2.5, at.position);
  EXPECT_DOUBLE_EQ(5, at.velocity);
  at = rampVelocity({0, 0}, 10, 5, 3);
  EXPECT_DOUBLE_EQ(20, at.position);
  EXPECT_DOUBLE_EQ(10, at.velocity);
  at = rampVelocity({0, 10}, -10, 5, 4);
  EXPECT_DOUBLE_EQ(0, at.position);
  EXPECT_DOUBLE_EQ(-10, at.velocity);
}

// 100 with v 10, a = d = 5: 12 s (test T-A1 of trapezoids: p(1) 2.5, p(2) 10, p(6) 50, p(10) 90).
TEST(Ramps, MoveIsTheTrapezoid) {
  const ProfileLimits limits = {10, 5, 5};
  MotionPoint at = {0, 0};
  const double expected[] = {2.5, 10, 20, 30, 40, 50, 60, 70, 80, 90, 97.5, 100};
  for (const double position : expected) {
    at = moveTo(at, 100, limits, 1);
    EXPECT_NEAR(position, at.position, 1e-9);
  }
  EXPECT_EQ(100, at.position);
  EXPECT_EQ(0, at.velocity);
}

// 10 with v 100, a 8, d 2: peak 5.656854249 after 0.707106781 s at 2, end after 3.535533906 s.
TEST(Ramps, ShortMoveHasAPeak) {
  const ProfileLimits limits = {100, 8, 2};
  const MotionPoint peak = moveTo({0, 0}, 10, limits, 0.70710678118654752);
  EXPECT_NEAR(2, peak.position, 1e-9);
  EXPECT_NEAR(5.6568542494923806, peak.velocity, 1e-9);
  EXPECT_NE(0, moveTo({0, 0}, 10, limits, 3.5355).velocity);
  EXPECT_EQ(0, moveTo({0, 0}, 10, limits, 3.5356).velocity);
}

// At 45 with 10, target 20, a = d = 10: brakes to 50 in 1 s, and is back after 5 s.
TEST(Ramps, OvershootReturns) {
  const ProfileLimits limits = {10, 10, 10};
  MotionPoint at = moveTo({45, 10}, 20, limits, 1);
  EXPECT_NEAR(50, at.position, 1e-9);
  EXPECT_NEAR(0, at.velocity, 1e-9);
  at = moveTo({45, 10}, 20, limits, 5 + 1e-9);
  EXPECT_EQ(20, at.position);
  EXPECT_EQ(0, at.velocity);
}

TEST(Ramps, TooFastBrakesToTheLimitFirst) {
  const MotionPoint at = moveTo({0, 20}, 100, {10, 10, 10}, 1);
  EXPECT_NEAR(15, at.position, 1e-9);
  EXPECT_NEAR(10, at.velocity, 1e-9);
}

}  // namespace
}  // namespace rung::motion
