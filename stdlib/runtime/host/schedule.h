// SPDX-License-Identifier: Apache-2.0
// Virtual time: which tasks run in a row, in which order, and at which time. A row is one period of the fastest cyclic
// task. Each resource has one processor. A task whose activations take time (`duration`) runs its code when it first
// gets the processor, and its outputs leave when its time is up; tasks of higher priority interrupt it meanwhile
// (TM/TP manual 1.5, AX 6.5). In: the tasks. Out: each activation run; faults and the watchdog stop the row.
#pragma once

#include <string>
#include <vector>

#include "hsio.h"
#include "tasks.h"

namespace rung::host {

class Schedule {
 public:
  // `others_go_on`: a fault stops its task alone. The interrupts of `hsio` start tasks at the times at which they
  // occur.
  Schedule(Tasks& tasks, rung_context& context, Hsio& hsio, bool others_go_on);

  enum class Ending : uint8_t { Complete, Faulted, Watchdog };
  // Runs all activations of row k, whose time begins at `begin_ns`. Faulted: the context has the fault.
  Ending run(int64_t begin_ns);
  // The named host event that starts an external task; false: no task waits for it.
  bool raise(const std::string& event);
  // After Watchdog: whose.
  const Task* stoppedTask() const { return stopped_; }
  // True when no activation is between its begin and its end.
  bool isIdle() const { return jobs_.empty(); }
  // Forgets all activations and starts the periods again at `now_ns`: after a reset.
  void restart(int64_t now_ns);

 private:
  struct State {  // of a task
    int64_t next_ns = 0;
    bool was_true = false;  // event: at the last sample
    bool raised = false;    // external: since the last row
  };
  struct Release {
    int64_t time_ns;
    uint32_t task;
  };
  // An activation that is released and not complete, in the order in which they get the processor of their resource.
  struct Job {
    uint32_t task;
    int64_t release_ns, start_ns = -1, left_ns = 0;
  };
  void release(int64_t begin_ns, int64_t end_ns);
  void releasePeriods(uint32_t task, int64_t end_ns);
  bool isFirstOfResource(size_t job) const;
  void enter(const Release& release);
  // Begins the job that waits at the front, or ends the one that is complete. False: none does.
  bool advance(int64_t now_ns, Ending& ending);
  bool begin(size_t job, int64_t now_ns, Ending& ending);
  bool finish(size_t job, int64_t now_ns, Ending& ending);
  int64_t firstEnd(int64_t now_ns, int64_t until_ns) const;
  int64_t firstInterrupt(int64_t until_ns);
  void spend(int64_t now_ns, int64_t until_ns);

  Tasks& tasks_;
  rung_context& context_;
  Hsio& hsio_;
  bool others_go_on_;
  const Task* stopped_ = nullptr;
  std::vector<State> states_;
  std::vector<Release> due_;
  std::vector<Release> interrupts_;  // that occurred and have no job yet
  std::vector<Job> jobs_;            // by priority; of equal priority in the order in which they came
};

}  // namespace rung::host
