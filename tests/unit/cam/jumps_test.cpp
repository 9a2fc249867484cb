// SPDX-License-Identifier: Apache-2.0
// A cam jumps where two pieces do not meet and where it repeats from another position, but not by rounding.
#include "cam/design/jumps.h"

#include <gtest/gtest.h>

namespace rung::cam {
namespace {

// y = 10 + x up to 1, then 10 + x + gap.
Cam twoPieces(double gap) {
  Cam cam;
  cam.kind = Kind::Polynomials;
  cam.polynomials = {{0, {10, 1}}, {1, {11 + gap, 1}}};
  cam.end = 3;
  return cam;
}

TEST(Jumps, WherePiecesDoNotMeet) {
  const std::vector<Jump> jumps = jumpsOf(curveOf(twoPieces(0.25)));
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_EQ(jumps[0].x, 1);
  EXPECT_EQ(jumps[0].size, 0.25);
}

TEST(Jumps, RoundingIsNotAJump) {
  // The stroke is 3: what is at most 3e-9 is rounding.
  EXPECT_TRUE(jumpsOf(curveOf(twoPieces(2e-9))).empty());
  EXPECT_EQ(jumpsOf(curveOf(twoPieces(4e-9))).size(), 1u);
}

TEST(Jumps, WhereACamRepeats) {
  Cam cam = twoPieces(0);  // from 10 to 13
  const Curve curve = curveOf(cam);
  EXPECT_EQ(jumpOfRepeat(cam, curve, Repeat::Never), std::nullopt);
  EXPECT_EQ(jumpOfRepeat(cam, curve, Repeat::Closed), -3);
  EXPECT_EQ(jumpOfRepeat(cam, curve, Repeat::Relative), 10);
  cam.slave_period = 1.5;
  EXPECT_EQ(jumpOfRepeat(cam, curve, Repeat::Modulo), std::nullopt);
  cam.slave_period = 2;
  EXPECT_EQ(jumpOfRepeat(cam, curve, Repeat::Modulo), 1);
}

}  // namespace
}  // namespace rung::cam
