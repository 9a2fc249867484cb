// SPDX-License-Identifier: Apache-2.0
// The drive as a whole: its way up on the fieldbus, injected faults and what they leave.
#include <gtest/gtest.h>

#include "drive/errors.h"
#include "drive_fixture.h"

namespace rung::motion {
namespace {

TEST(SimulatedDrive, IsOperationalInItsFirstCycle) {
  TestDrive test;
  test.drive.start_position_ = -42;
  test.step();
  EXPECT_EQ(8, test.drive.bus_state_);
  EXPECT_EQ(1, test.data.communication);
  EXPECT_EQ(0x250, test.data.statusword);
  EXPECT_EQ(-42, test.data.position);
}

TEST(SimulatedDrive, TakesTheStatesOfTheBusStepByStep) {
  TestDrive test;
  test.drive.bus_cycles_ = 2;
  uint8_t states[9];
  for (uint8_t& state : states) {
    test.step();
    state = test.drive.bus_state_;
    EXPECT_EQ(state == 8, test.data.communication == 1);
    EXPECT_EQ(state >= 4, test.data.mapped != 0);
  }
  const uint8_t expected[] = {1, 1, 2, 2, 4, 4, 8, 8, 8};
  for (int i = 0; i < 9; ++i) EXPECT_EQ(expected[i], states[i]) << i;
}

TEST(SimulatedDrive, ARequestForNoStateRaisesTheErrorFlag) {
  TestDrive test;
  test.drive.requested_state_ = 5;
  test.step();
  EXPECT_EQ(1, test.drive.bus_state_);
  EXPECT_TRUE(test.drive.bus_error_);
  test.drive.requested_state_ = 3;
  test.step();
  EXPECT_EQ(3, test.drive.bus_state_) << "Boot";
  EXPECT_FALSE(test.drive.bus_error_);
}

TEST(SimulatedDrive, SafeOpTakesNoOutputs) {
  TestDrive test;
  test.drive.requested_state_ = 4;
  test.enable(8);
  EXPECT_EQ(0x40, test.data.statusword & 0x4F);
  EXPECT_EQ(0, test.data.communication);
}

// Each cycle has a logical write and a logical read, to which the slave adds 1 each; in SafeOp it takes no outputs.
TEST(SimulatedDrive, TheWorkingCounterTellsThatTheSlaveTakesPart) {
  TestDrive test;
  test.step();
  EXPECT_EQ(2, test.drive.working_counter_);
  test.drive.requested_state_ = 4;
  test.step();
  EXPECT_EQ(1, test.drive.working_counter_);
  test.drive.requested_state_ = 2;
  test.step();
  EXPECT_EQ(0, test.drive.working_counter_);
  EXPECT_EQ(0, test.data.communication);
}

TEST(SimulatedDrive, OutputsThatAreRefusedDoNotArrive) {
  TestDrive test;
  test.enable(8);
  test.data.target_position = 100;
  test.step();
  EXPECT_EQ(100, test.data.position);
  test.drive.outputs_refused_ = 1;
  test.data.target_position = 200;
  test.step();
  EXPECT_EQ(1, test.drive.working_counter_);
  EXPECT_EQ(0, test.data.communication);
  EXPECT_EQ(100, test.data.position);
  test.drive.outputs_refused_ = 0;
  test.step();
  EXPECT_EQ(1, test.data.communication);
  EXPECT_EQ(200, test.data.position);
}

TEST(SimulatedDrive, InputsThatAreRefusedStayAsTheyWere) {
  TestDrive test;
  test.enable(8);
  test.drive.inputs_refused_ = 1;
  test.data.target_position = 100;
  test.step();
  EXPECT_EQ(1, test.drive.working_counter_);
  EXPECT_EQ(0, test.data.communication);
  EXPECT_EQ(0, test.data.position);
  EXPECT_EQ(100.0, test.drive.machine_position_) << "the drive has the set value";
  test.drive.inputs_refused_ = 0;
  test.step();
  EXPECT_EQ(100, test.data.position);
}

TEST(SimulatedDrive, FaultWithCodeAndReset) {
  TestDrive test;
  test.enable(9);
  test.data.target_velocity = 50000;
  test.run(10);
  test.drive.fault_code_ = 0x2310;
  test.step();
  EXPECT_EQ(0x0F, test.data.statusword & 0x4F) << "fault reaction";
  EXPECT_EQ(0x2310, test.data.error_code);
  test.run(6);  // 50 000/s with 10 000 000/s²
  EXPECT_EQ(0x08, test.data.statusword & 0x4F);
  EXPECT_EQ(0, test.data.velocity);
  test.step(uint16_t{0x80});
  EXPECT_EQ(0x08, test.data.statusword & 0x4F) << "the cause is still there";
  test.drive.fault_code_ = 0;
  test.step(uint16_t{0});
  test.step(uint16_t{0x80});
  EXPECT_EQ(0x40, test.data.statusword & 0x4F);
  EXPECT_EQ(0, test.data.error_code);
}

TEST(SimulatedDrive, LostSupply) {
  TestDrive test;
  test.enable(8);
  test.drive.power_lost_ = 1;
  test.step();
  EXPECT_EQ(0, test.data.statusword & 0x10) << "no voltage";
  EXPECT_EQ(kUndervoltage, test.data.error_code);
  test.step();
  EXPECT_EQ(0x08, test.data.statusword & 0x4F);
  test.step(uint16_t{0x80});
  test.step(uint16_t{0x06});
  test.step(uint16_t{0x07});
  EXPECT_EQ(0x21, test.data.statusword & 0x6F) << "does not switch on without supply";
  test.drive.power_lost_ = 0;
  test.step();
  EXPECT_EQ(0x23, test.data.statusword & 0x6F);
}

TEST(SimulatedDrive, LostCommunication) {
  TestDrive test;
  test.enable(9);
  test.data.target_velocity = 50000;
  test.run(10);
  const int32_t before = test.data.position;
  test.drive.communication_lost_ = 1;
  test.run(20);
  EXPECT_EQ(0, test.data.communication);
  EXPECT_EQ(before, test.data.position) << "nothing arrives";
  EXPECT_EQ(0, test.drive.machine_velocity_) << "the drive has stopped by itself";
  EXPECT_GT(test.drive.machine_position_, before);
  test.drive.communication_lost_ = 0;
  test.step();
  EXPECT_EQ(1, test.data.communication);
  EXPECT_EQ(0x08, test.data.statusword & 0x4F);
  EXPECT_EQ(kCommunication, test.data.error_code);
}

TEST(SimulatedDrive, InputsAreShown) {
  TestDrive test;
  test.drive.home_switch_ = 1;
  test.drive.negative_limit_ = 1;
  test.step();
  EXPECT_EQ(5u, test.data.digital_inputs);
  test.drive.negative_limit_ = 0;
  test.drive.positive_limit_ = 1;
  test.step();
  EXPECT_EQ(6u, test.data.digital_inputs);
}

}  // namespace
}  // namespace rung::motion
