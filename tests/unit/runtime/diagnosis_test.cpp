// SPDX-License-Identifier: Apache-2.0
// The table of current faults as a host uses it (rung/diagnosis.h): order, limits, indicators, reports from two
// threads.
#include "rung/diagnosis.h"

#include <gtest/gtest.h>
#include <thread>

namespace {

TEST(Diagnosis, OldestFirst) {
  rung_diagnosis table{};
  EXPECT_TRUE(rung_report_fault(&table, 0x29, 1, 300));
  EXPECT_TRUE(rung_report_fault(&table, 0xa0, 2, 100));
  EXPECT_TRUE(rung_report_fault(&table, 0x400005, 3, 200));
  rung_current_fault faults[4];
  ASSERT_EQ(rung_current_faults(&table, faults, 4), 3u);
  EXPECT_EQ(faults[0].code, 0xa0u);
  EXPECT_EQ(faults[1].source, 3u);
  EXPECT_EQ(faults[2].since_ns, 300);
  EXPECT_EQ(rung_display_code(&table), 0xa0);
  ASSERT_EQ(rung_current_faults(&table, faults, 2), 2u);
  EXPECT_EQ(faults[0].code, 0xa0u);
  EXPECT_EQ(faults[1].code, 0x400005u);
}

TEST(Diagnosis, Indicators) {
  rung_diagnosis table{};
  EXPECT_EQ(rung_indicators(&table), 0);
  table.stopped = 1;
  EXPECT_EQ(rung_indicators(&table), RUNG_INDICATOR_SF);
  EXPECT_TRUE(rung_report_fault(&table, 0x20, 0, 0));
  EXPECT_EQ(rung_indicators(&table), RUNG_INDICATOR_SF | RUNG_INDICATOR_BF);
  EXPECT_TRUE(rung_clear_fault(&table, 0x20, 0));
  EXPECT_EQ(rung_indicators(&table), RUNG_INDICATOR_SF);
}

TEST(Diagnosis, WithoutTable) {
  EXPECT_FALSE(rung_report_fault(nullptr, 1, 0, 0));
  EXPECT_FALSE(rung_clear_fault(nullptr, 1, 0));
  EXPECT_EQ(rung_current_faults(nullptr, nullptr, 0), 0u);
  EXPECT_EQ(rung_indicators(nullptr), 0);
  EXPECT_EQ(rung_display_code(nullptr), 0);
}

TEST(Diagnosis, TwoThreads) {
  rung_diagnosis table{};
  const auto work = [&](uint32_t source) {
    for (int i = 0; i < 20000; ++i) {
      ASSERT_TRUE(rung_report_fault(&table, 0x25, source, i));
      ASSERT_TRUE(rung_clear_fault(&table, 0x25, source));
    }
  };
  std::thread one(work, 1), two(work, 2);
  rung_current_fault faults[RUNG_DIAGNOSIS_ENTRIES];
  for (int i = 0; i < 1000; ++i) {
    const uint32_t count = rung_current_faults(&table, faults, RUNG_DIAGNOSIS_ENTRIES);
    ASSERT_LE(count, 2u);
    for (uint32_t f = 0; f < count; ++f) ASSERT_EQ(faults[f].code, 0x25u);
  }
  one.join();
  two.join();
  EXPECT_EQ(rung_current_faults(&table, faults, RUNG_DIAGNOSIS_ENTRIES), 0u);
}

}  // namespace
