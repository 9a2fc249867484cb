// SPDX-License-Identifier: Apache-2.0
// Charts of the order of tasks, as computed by hand.
#include "tools/driver/task_chart.h"

#include <gtest/gtest.h>

namespace rung::driver {
namespace {

constexpr int64_t kMs = 1'000'000;
using Rows = std::vector<std::string>;

TEST(TaskChart, without_durations_a_mark_is_a_start) {
  const ChartTask tasks[] = {{10 * kMs, 0, 1}, {30 * kMs, 0, 2}, {0, 0, 3}};
  const TaskChart chart = chartOf(tasks);
  EXPECT_EQ(chart.column_ns, 10 * kMs);
  EXPECT_EQ(chart.hyperperiod_ns, 30 * kMs);
  EXPECT_TRUE(chart.complete);
  EXPECT_EQ(chart.rows, (Rows{"###", "#..", "#.."}));
}

// TM/TP manual 1.5: 10, 30 and 40 ms. With 5, 10 and 5 ms, task 2 needs the rest of two periods of task 1, and task 3
// the first rest that task 2 leaves.
TEST(TaskChart, a_higher_task_interrupts_a_lower_one) {
  const ChartTask tasks[] = {{10 * kMs, 5 * kMs, 0}, {30 * kMs, 10 * kMs, 1}, {40 * kMs, 5 * kMs, 2}};
  const TaskChart chart = chartOf(tasks);
  EXPECT_EQ(chart.column_ns, 5 * kMs);
  EXPECT_EQ(chart.hyperperiod_ns, 120 * kMs);
  EXPECT_EQ(chart.rows[0], "#.#.#.#.#.#.#.#.#.#.#.#.");
  EXPECT_EQ(chart.rows[1], "-#-#..-#-#..-#-#..-#-#..");
  EXPECT_EQ(chart.rows[2], "-----#..---#....-#......");
}

TEST(TaskChart, a_start_that_comes_too_late_is_dropped) {
  const ChartTask tasks[] = {{10 * kMs, 15 * kMs, 0}, {20 * kMs, 5 * kMs, 1}};
  EXPECT_EQ(chartOf(tasks).rows, (Rows{"###.", "---#"}));
}

TEST(TaskChart, a_long_hyperperiod_is_cut) {
  const ChartTask tasks[] = {{10 * kMs, 0, 0}, {7 * kMs + 1, 0, 1}};
  const TaskChart chart = chartOf(tasks);
  EXPECT_FALSE(chart.complete);
  EXPECT_EQ(chart.column_ns, 7 * kMs + 1);
  EXPECT_EQ(chart.rows[0].size(), 60u);
}

TEST(TaskChart, one_task_or_none) {
  EXPECT_TRUE(chartOf({}).rows.empty());
  const ChartTask once[] = {{0, 0, 0}};
  EXPECT_EQ(chartOf(once).rows, Rows{"#"});
}

}  // namespace
}  // namespace rung::driver
