// SPDX-License-Identifier: Apache-2.0
// Touch probes: edges, sources and single or continuous latching, for both probes.
#include "drive/probes.h"

#include <gtest/gtest.h>

#include "drive_fixture.h"

namespace rung::motion {
namespace {

struct Probes : TestDrive {
  Probes() {
    drive.probe_1_from_ = 1234;
    drive.probe_1_to_ = 2345;
    drive.probe_2_from_ = 3456;
    drive.probe_2_to_ = 4567;
    drive.z_pulse_ = 500;
    enable(8);
  }
  void moveTo(int position) {
    while (data.position != position) {
      const int step_size = position > data.position ? 100 : -100;
      const int left = position - data.position;
      data.target_position += left * left < 10000 ? left : step_size;
      step();
    }
  }
};

TEST(Probes, LatchesBothEdgesOfBothInputs) {
  Probes test;
  test.data.probe_function = 0x3131;
  test.step();
  EXPECT_EQ(0x0101, test.data.probe_status);
  test.moveTo(6000);
  EXPECT_EQ(0x0707, test.data.probe_status);
  EXPECT_EQ(1234, test.data.probe_1_rising);
  EXPECT_EQ(2345, test.data.probe_1_falling);
  EXPECT_EQ(3456, test.data.probe_2_rising);
  EXPECT_EQ(4567, test.data.probe_2_falling);
}

TEST(Probes, BackwardsTheEdgesChange) {
  Probes test;
  test.moveTo(6000);
  test.data.probe_function = 0x31;
  test.moveTo(0);
  EXPECT_EQ(2345, test.data.probe_1_rising);
  EXPECT_EQ(1234, test.data.probe_1_falling);
}

TEST(Probes, OnlyTheEdgesAskedFor) {
  Probes test;
  test.data.probe_function = 0x11;
  test.moveTo(6000);
  EXPECT_EQ(0x03, test.data.probe_status);
  EXPECT_EQ(0, test.data.probe_1_falling);
}

TEST(Probes, SingleKeepsTheFirstContinuousTheLast) {
  for (const bool is_continuous : {false, true}) {
    Probes test;
    test.data.probe_function = is_continuous ? 0x13 : 0x11;
    test.moveTo(6000);
    test.moveTo(0);
    EXPECT_EQ(is_continuous ? 2345 : 1234, test.data.probe_1_rising);
  }
}

TEST(Probes, ArmedAgainItForgets) {
  Probes test;
  test.data.probe_function = 0x11;
  test.moveTo(6000);
  test.data.probe_function = 0;
  test.step();
  EXPECT_EQ(0, test.data.probe_status);
  test.data.probe_function = 0x11;
  test.moveTo(0);
  EXPECT_EQ(2345, test.data.probe_1_rising);
}

TEST(Probes, ZPulse) {
  Probes test;
  test.data.probe_function = 0x15;
  test.moveTo(6000);
  EXPECT_EQ(0x03, test.data.probe_status);
  EXPECT_EQ(500, test.data.probe_1_rising);
  test.data.probe_function = 0x17;
  test.moveTo(11000);
  EXPECT_EQ(10500, test.data.probe_1_rising);
}

TEST(Probes, InputSetByHand) {
  Probes test;
  test.drive.probe_1_to_ = 0;
  test.data.probe_function = 0x31;
  test.moveTo(700);
  test.drive.probe_1_ = 1;
  test.step();
  EXPECT_EQ(0x03, test.data.probe_status);
  EXPECT_EQ(700, test.data.probe_1_rising);
  EXPECT_NE(0u, test.data.digital_inputs & kProbeInput1);
  test.drive.probe_1_ = 0;
  test.moveTo(900);
  EXPECT_EQ(700, test.data.probe_1_falling);
}

}  // namespace
}  // namespace rung::motion
