// Real time: a thread per task with absolute deadlines, SCHED_FIFO where the system permits, watchdogs, and statistics
// of periods. In: a schedule and the hooks of a row. Out: why the run ended. Stops at a signal (SIGINT, SIGTERM).
#pragma once

#include <functional>
#include <string>

#include "schedule.h"

namespace rung::host {

struct RealtimeResult {
  int64_t rows = 0;
  bool faulted = false;
  rung_fault fault{};
  bool hung = false;       // after a signal or the time limit, a thread is still inside the program
  std::string watchdog;    // the task whose watchdog ended the run
  std::string statistics;  // lines for the user
};

// `before(row)` and `after(row)` run in the thread of the fastest cyclic task, around its activation. `rows` < 0: until
// a signal arrives or `timeout_ns` are over (0: none). `idle` runs about once a second in the caller's thread.
RealtimeResult runRealtime(Schedule& schedule, rung_context& context, int64_t rows, int64_t timeout_ns,
                           const std::function<void(int64_t)>& before, const std::function<void(int64_t)>& after,
                           const std::function<void()>& idle);

}  // namespace rung::host
