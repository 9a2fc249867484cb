// SPDX-License-Identifier: Apache-2.0
// The order in which tasks run; see task_chart.h.
#include "tools/driver/task_chart.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace rung::driver {
namespace {

constexpr int64_t kMostColumns = 60;
constexpr int64_t kNever = std::numeric_limits<int64_t>::max();

// Of all intervals; 0 when it does not fit.
int64_t hyperperiodOf(std::span<const ChartTask> tasks) {
  int64_t all = 1;
  for (const ChartTask& task : tasks) {
    if (task.interval_ns <= 0) continue;
    const int64_t factor = task.interval_ns / std::gcd(all, task.interval_ns);
    if (__builtin_mul_overflow(all, factor, &all)) return 0;
  }
  return all;
}

// As fine as the times are, as long as the hyperperiod fits; else the shortest interval.
int64_t columnOf(std::span<const ChartTask> tasks, int64_t hyperperiod) {
  int64_t intervals = 0, times = 0, shortest = kNever;
  for (const ChartTask& task : tasks) {
    times = std::gcd(times, task.duration_ns);
    if (task.interval_ns <= 0) continue;
    intervals = std::gcd(intervals, task.interval_ns);
    shortest = std::min(shortest, task.interval_ns);
  }
  if (intervals == 0) return times > 0 ? times : 1;
  for (const int64_t column : {std::gcd(times, intervals), intervals})
    if (hyperperiod > 0 && hyperperiod / column <= kMostColumns) return column;
  return shortest;
}

class Simulation {
 public:
  Simulation(std::span<const ChartTask> tasks, TaskChart& chart, int64_t columns)
      : tasks_(tasks), chart_(chart), end_(columns * chart.column_ns), states_(tasks.size()) {
    chart_.rows.assign(tasks.size(), std::string(static_cast<size_t>(columns), '.'));
  }

  void run() {
    for (int64_t now = 0; now < end_;) {
      release(now);
      const int64_t next = nextRelease();
      const size_t task = highest();
      if (task == tasks_.size()) {
        now = next;
        continue;
      }
      State& state = states_[task];
      const int64_t until = std::min({now + state.left, next, end_});
      mark(task, now, until, '#');
      state.left -= until - now;
      now = until;
      if (state.left == 0) finish(task, now);
    }
    for (size_t i = 0; i < tasks_.size(); ++i)
      if (states_[i].ready) finish(i, end_);
  }

 private:
  struct State {
    int64_t next = 0, released = 0, left = 0;
    bool ready = false;
  };

  // A start that comes while the task still runs is dropped.
  void release(int64_t now) {
    for (size_t i = 0; i < tasks_.size(); ++i) {
      State& state = states_[i];
      if (state.next > now) continue;
      state.next = tasks_[i].interval_ns > 0 ? state.next + tasks_[i].interval_ns : kNever;
      if (state.ready) continue;
      state.ready = true;
      state.released = now;
      state.left = tasks_[i].duration_ns;
    }
  }

  int64_t nextRelease() const {
    int64_t next = kNever;
    for (const State& state : states_) next = std::min(next, state.next);
    return next;
  }

  size_t highest() const {
    size_t found = tasks_.size();
    for (size_t i = 0; i < tasks_.size(); ++i)
      if (states_[i].ready && (found == tasks_.size() || tasks_[i].priority < tasks_[found].priority)) found = i;
    return found;
  }

  // It waited wherever it did not run since its release.
  void finish(size_t task, int64_t now) {
    states_[task].ready = false;
    if (now > states_[task].released) mark(task, states_[task].released, now, '-');
  }

  // The columns that [from, to) touches; a moment touches one.
  void mark(size_t task, int64_t from, int64_t to, char sign) {
    const int64_t last = to > from ? (to - 1) / chart_.column_ns : from / chart_.column_ns;
    for (int64_t column = from / chart_.column_ns; column <= last; ++column) {
      char& cell = chart_.rows[task][static_cast<size_t>(column)];
      if (cell != '#') cell = sign;
    }
  }

  std::span<const ChartTask> tasks_;
  TaskChart& chart_;
  int64_t end_;
  std::vector<State> states_;
};

}  // namespace

TaskChart chartOf(std::span<const ChartTask> tasks) {
  TaskChart chart;
  chart.hyperperiod_ns = hyperperiodOf(tasks);
  chart.column_ns = columnOf(tasks, chart.hyperperiod_ns);
  int64_t columns = kMostColumns;
  if (chart.hyperperiod_ns > 0 && chart.hyperperiod_ns / chart.column_ns <= kMostColumns) {
    columns = std::max<int64_t>(1, (chart.hyperperiod_ns + chart.column_ns - 1) / chart.column_ns);
    chart.complete = true;
  }
  Simulation(tasks, chart, columns).run();
  return chart;
}

}  // namespace rung::driver
