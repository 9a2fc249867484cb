// SPDX-License-Identifier: Apache-2.0
// The order in which the tasks of one resource run when all start together: on one CPU, a higher priority interrupts a
// lower one. In: intervals, priorities and simulated execution times. Out: a row of marks per task, over one
// hyperperiod or its first columns. Called by `rung list tasks`. Cost: columns × tasks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rung::driver {

struct ChartTask {
  int64_t interval_ns = 0;  // 0: runs once, at the start
  int64_t duration_ns = 0;
  uint32_t priority = 0;  // 0 highest; equal: the first one
};

struct TaskChart {
  int64_t column_ns = 0;
  int64_t hyperperiod_ns = 0;     // 0: does not fit
  bool complete = false;          // the columns show the whole hyperperiod
  std::vector<std::string> rows;  // by task: `#` runs, `-` waits, `.` neither
};

TaskChart chartOf(std::span<const ChartTask> tasks);

}  // namespace rung::driver
