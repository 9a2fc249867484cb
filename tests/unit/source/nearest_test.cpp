// SPDX-License-Identifier: Apache-2.0
// "Did you mean": similar names are found in any case; distant names give none, ties the first by name.
#include <gtest/gtest.h>

#include "frontend/source/diagnostics.h"

namespace rung {
namespace {

TEST(Nearest, FindsSlips) {
  EXPECT_EQ(nearest("presure", {"level", "pressure", "flow"}), "pressure");
  EXPECT_EQ(nearest("PRESSRUE", {"level", "pressure"}), "pressure");
  EXPECT_EQ(nearest("conveyorOn", {"conveyor_on", "conveyor_off"}), "conveyor_on");
  EXPECT_EQ(nearest("tno", {"TON", "TP"}), "TON");
  EXPECT_EQ(nearest("xy", {"x", "zz"}), "x");
}

TEST(Nearest, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest("pump", {"valve", "level"}), "");
  EXPECT_EQ(nearest("x", {"y", "z"}), "");
  EXPECT_EQ(nearest("ab", {"cd"}), "");
  EXPECT_EQ(nearest("pump", {}), "");
  EXPECT_EQ(nearest(std::string(1000, 'a'), {"a"}), "");
}

TEST(Nearest, TakesABeginningBeforeTwoSlips) {
  EXPECT_EQ(nearest("MC_Pow", {"MC_Jog", "MC_Power", "MC_PowerDown"}), "MC_Power");
  EXPECT_EQ(nearest("pressures", {"pressure", "pressures_all"}), "pressure");
}

TEST(Nearest, FindsByBeginning) {
  EXPECT_EQ(nearestByBeginning("mc_Ga", {"MC_GearIn"}), "");
  EXPECT_EQ(nearestByBeginning("mc_Ge", {"MC_GearIn", "MC_GearOut"}), "MC_GearIn");
  EXPECT_EQ(nearestByBeginning("ASSERT_TRUE", {"ASSERT", "ASSERT_EQ"}), "ASSERT");
  EXPECT_EQ(nearestByBeginning("abc", {"abcdefgh"}), "");
}

TEST(Nearest, DoesNotDependOnTheOrder) {
  EXPECT_EQ(nearest("in3", {"in2", "in1"}), "in1");
  EXPECT_EQ(nearest("in3", {"in1", "in2"}), "in1");
}

}  // namespace
}  // namespace rung
