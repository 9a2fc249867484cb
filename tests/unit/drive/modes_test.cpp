// SPDX-License-Identifier: Apache-2.0
// The modes of operation: set values, statusword bits and the stops of the drive.
#include "drive/modes.h"

#include <gtest/gtest.h>

#include <math.h>

#include "drive_fixture.h"

namespace rung::motion {
namespace {

constexpr uint16_t kReached = 0x400, kInternalLimit = 0x800, kBit12 = 0x1000, kBit13 = 0x2000;

TEST(Modes, CyclicPositionFollowsAndWraps) {
  TestDrive test;
  test.enable(8);
  test.data.target_position = 1000;
  test.step();
  EXPECT_EQ(1000, test.data.position);
  EXPECT_EQ(1000000, test.data.velocity);
  EXPECT_NE(0, test.data.statusword & kBit12) << "follows the command";
  // 32 bits overflow: the machine goes on.
  for (int i = 0; i < 50; ++i) {
    test.data.target_position = static_cast<int32_t>(static_cast<uint32_t>(test.data.target_position) + 100000000u);
    test.step();
  }
  EXPECT_EQ(5000001000.0, test.drive.machine_position_);
  EXPECT_EQ(test.data.target_position, test.data.position);
}

TEST(Modes, CyclicPositionKeepsTheLimitsOf607D) {
  TestDrive test;
  test.drive.min_position_limit_ = -500;
  test.drive.max_position_limit_ = 500;
  test.enable(8);
  test.data.target_position = 700;
  test.step();
  EXPECT_EQ(500, test.data.position);
  EXPECT_NE(0, test.data.statusword & kInternalLimit);
}

// x' = (demand - x) / T for a steady velocity v lags by v T; after the first cycle of 1 ms with T = 10 ms: v T (e^-0.1
// - 1) + v dt.
TEST(Modes, FirstOrderLag) {
  TestDrive test;
  test.drive.time_constant_ = 0.01;
  test.enable(8);
  test.data.target_position = 100000;
  test.step();
  EXPECT_NEAR(100000 + 100000000 * 0.01 * (exp(-0.1) - 1), test.drive.machine_position_, 1e-6);
  for (int i = 0; i < 1000; ++i) {
    test.data.target_position += 100000;
    test.step();
  }
  EXPECT_NEAR(100000000 * 0.01, test.drive.demand_ - test.drive.machine_position_, 1e-3);
}

TEST(Modes, CyclicVelocity) {
  TestDrive test;
  test.enable(9);
  test.data.target_velocity = 50000;
  test.run(10);
  EXPECT_EQ(500, test.data.position);
  EXPECT_EQ(50000, test.data.velocity);
  test.drive.max_profile_velocity_ = 20000;
  test.step();
  EXPECT_EQ(20000, test.data.velocity);
}

// Inertia 0.001, load 100: a torque of 600 accelerates with 500 000 increments/s².
TEST(Modes, CyclicTorque) {
  TestDrive test;
  test.drive.load_ = 100;
  test.data.target_torque = 100;
  test.enable(10);
  test.data.target_torque = 600;
  test.run(100);
  EXPECT_NEAR(50000, test.drive.machine_velocity_, 1e-6);
  EXPECT_NEAR(2500, test.drive.machine_position_, 1e-6);
  EXPECT_EQ(600, test.data.torque);
  test.data.target_torque = 5000;
  test.step();
  EXPECT_EQ(3000, test.data.torque) << "6072h limits it";
}

TEST(Modes, TorqueSlope) {
  TestDrive test;
  test.drive.torque_slope_ = 10000;
  test.enable(10);
  test.data.target_torque = 100;
  test.step();
  EXPECT_EQ(10, test.data.torque);
  test.run(9);
  EXPECT_EQ(100, test.data.torque);
}

TEST(Modes, TorqueOfAnAcceleration) {
  TestDrive test;
  test.drive.damping_ = 0.001;
  test.enable(9);
  test.data.target_velocity = 100;  // in 1 ms: 100 000 increments/s²
  test.step();
  EXPECT_NEAR(100 + 0.1, test.drive.torque_, 1e-9);
}

// 100 000 with 100 000/s and 1 000 000/s²: 0.1 s up, 0.9 s cruise, 0.1 s down.
TEST(Modes, ProfilePosition) {
  TestDrive test;
  test.enable(1);
  test.data.target_position = 100000;
  test.step(uint16_t{0x1F});
  EXPECT_NE(0, test.data.statusword & kBit12) << "acknowledged";
  test.step(uint16_t{0x0F});
  EXPECT_EQ(0, test.data.statusword & kBit12);
  EXPECT_EQ(0, test.data.statusword & kReached);
  test.run(98);
  EXPECT_EQ(5000, test.data.position);
  test.run(1000 - 1);
  EXPECT_EQ(0, test.data.statusword & kReached);
  test.run(2);
  EXPECT_EQ(100000, test.data.position);
  EXPECT_NE(0, test.data.statusword & kReached);
}

TEST(Modes, ProfilePositionKeepsOneSetPoint) {
  TestDrive test;
  test.enable(1);
  test.data.target_position = 1000;
  test.step(uint16_t{0x1F});
  test.step(uint16_t{0x0F});
  test.data.target_position = 3000;
  test.step(uint16_t{0x1F});
  test.step(uint16_t{0x0F});
  EXPECT_NE(0, test.data.statusword & kBit12) << "acknowledged until it is taken";
  test.runUntil(kReached);
  EXPECT_EQ(3000, test.data.position);
  EXPECT_EQ(0, test.data.statusword & kBit12);
}

TEST(Modes, ProfilePositionChangesImmediately) {
  TestDrive test;
  test.enable(1);
  test.data.target_position = 100000;
  test.step(uint16_t{0x1F});
  test.step(uint16_t{0x0F});
  test.run(100);
  test.data.target_position = -2000;
  test.step(uint16_t{0x3F});
  test.step(uint16_t{0x0F});
  test.runUntil(kReached);
  EXPECT_EQ(-2000, test.data.position);
}

TEST(Modes, ProfilePositionRelative) {
  TestDrive test;
  test.enable(1);
  test.data.target_position = 1000;
  for (int i = 0; i < 2; ++i) {
    test.step(uint16_t{0x5F});
    test.step(uint16_t{0x0F});
    test.runUntil(kReached);
  }
  EXPECT_EQ(2000, test.data.position);
}

TEST(Modes, PositionWindowAndItsTime) {
  TestDrive test;
  test.drive.time_constant_ = 0.01;
  test.drive.position_window_ = 10;
  test.drive.position_window_time_ = 20;
  test.enable(1);
  test.data.target_position = 10000;
  test.step(uint16_t{0x1F});
  while (fabs(rint(10000 - test.drive.machine_position_)) > 10 || test.drive.demand_velocity_ != 0) test.step();
  EXPECT_EQ(0, test.data.statusword & kReached);
  test.run(18);
  EXPECT_EQ(0, test.data.statusword & kReached);
  test.run(2);
  EXPECT_NE(0, test.data.statusword & kReached);
}

TEST(Modes, ProfileVelocity) {
  TestDrive test;
  test.drive.profile_deceleration_ = 2000000;
  test.enable(3);
  EXPECT_NE(0, test.data.statusword & kBit12) << "velocity 0";
  test.data.target_velocity = 50000;
  test.run(25);
  EXPECT_EQ(25000, test.data.velocity);
  EXPECT_EQ(0, test.data.statusword & (kBit12 | kReached));
  test.run(25);
  EXPECT_EQ(50000, test.data.velocity);
  EXPECT_NE(0, test.data.statusword & kReached);
  // Down to 0 with 2 000 000/s², then up with 1 000 000/s²: 25 ms and 50 ms.
  test.data.target_velocity = -50000;
  test.run(25);
  EXPECT_NEAR(0, test.data.velocity, 1);
  test.run(50);
  EXPECT_EQ(-50000, test.data.velocity);
}

TEST(Modes, HaltBrakesAndGoesOn) {
  TestDrive test;
  test.enable(3);
  test.data.target_velocity = 50000;
  test.run(100);
  test.step(uint16_t{0x10F});
  test.run(49);
  EXPECT_EQ(0, test.data.velocity);
  EXPECT_NE(0, test.data.statusword & kReached);
  test.step(uint16_t{0x0F});
  test.run(50);
  EXPECT_EQ(50000, test.data.velocity);
}

// Quick stop with 10 000 000/s² from 50 000/s: 5 ms; then power off (option 2) or on (option 6).
TEST(Modes, QuickStopOptions) {
  for (const int16_t option : {0, 1, 2, 5, 6}) {
    TestDrive test;
    test.drive.quick_stop_option_ = option;
    test.enable(9);
    test.data.target_velocity = 50000;
    test.run(10);
    test.step(uint16_t{0x0B});
    EXPECT_EQ(0x07, test.data.statusword & 0x6F) << option;
    test.run(2);
    if (option == 0) {
      EXPECT_EQ(0x40, test.data.statusword & 0x4F);
      continue;
    }
    const bool is_slow = option == 1 || option == 5;
    EXPECT_EQ(is_slow ? 47000 : 20000, test.data.velocity) << option;
    test.run(is_slow ? 60 : 10);
    EXPECT_EQ(0, test.data.velocity);
    EXPECT_EQ(option >= 5 ? 0x07 : 0x40, test.data.statusword & 0x4F) << option;
    if (option < 5) continue;
    test.data.target_velocity = 0;
    test.step(uint16_t{0x0F});
    EXPECT_EQ(0x27, test.data.statusword & 0x6F) << option;
  }
}

TEST(Modes, DisableAndShutdownOptions) {
  for (const uint16_t command : {7, 6})
    for (const int16_t option : {0, 1}) {
      TestDrive test;
      (command == 7 ? test.drive.disable_option_ : test.drive.shutdown_option_) = option;
      test.enable(9);
      test.data.target_velocity = 50000;
      test.run(10);
      test.step(command);
      const int expected = command == 7 ? 0x23 : 0x21;
      EXPECT_EQ(option == 0 ? expected : 0x27, test.data.statusword & 0x6F);
      test.run(51);
      EXPECT_EQ(expected, test.data.statusword & 0x6F);
      EXPECT_EQ(0, test.data.velocity);
    }
}

TEST(Modes, FollowingErrorAfterItsTimeout) {
  TestDrive test;
  test.drive.following_error_window_ = 100;
  test.drive.following_error_timeout_ = 5;
  test.enable(8);
  test.drive.blocked_ = 1;
  test.data.target_position = 101;
  test.step();
  EXPECT_NE(0, test.data.statusword & kBit13);
  test.run(5);
  EXPECT_EQ(0x27, test.data.statusword & 0x6F);
  test.run(3);
  EXPECT_EQ(0x08, test.data.statusword & 0x4F);
  EXPECT_EQ(0x8611, test.data.error_code);
}

TEST(Modes, AnUnknownModeChangesNothing) {
  TestDrive test;
  test.enable(8);
  test.data.mode = 4;
  test.step();
  EXPECT_EQ(8, test.data.mode_display);
}

}  // namespace
}  // namespace rung::motion
