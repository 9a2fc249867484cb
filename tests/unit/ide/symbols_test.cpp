// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/symbols.h"

#include <gtest/gtest.h>

namespace rung::ide {
namespace {

TEST(MatchScore, PrefersBeginningsOfWords) {
  const auto better = [](const char* good, const char* bad, const char* query) {
    EXPECT_GT(matchScore(good, query), matchScore(bad, query)) << query;
    EXPECT_GT(matchScore(bad, query), 0) << query;
  };
  better("Pump", "PumpStation", "pump");
  better("PumpStation", "MyPump", "pump");
  better("FB_ValveControl", "FB_Evacuate", "vc");
  better("motor_start", "MotorStatistics", "mst");
  better("PC", "pump_cycle", "pc");
}

TEST(MatchScore, NeedsAllLettersInOrder) {
  EXPECT_EQ(matchScore("Pump", "pumps"), 0);
  EXPECT_EQ(matchScore("Pump", "mp_"), 0);
  EXPECT_EQ(matchScore("ab", "ba"), 0);
  EXPECT_GT(matchScore("ab", ""), 0);
  EXPECT_EQ(matchScore("", "a"), 0);
}

}  // namespace
}  // namespace rung::ide
