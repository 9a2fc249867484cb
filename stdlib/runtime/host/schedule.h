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

  // Begins the row whose time begins at `begin_ns`: finds the activations that become due in it.
  void beginRow(int64_t begin_ns);
  // Tells whether a row has begun and is not complete.
  bool isInRow() const { return is_in_row_; }
  // The next activation of the row: its code, and unless it takes time its end. False: the row is complete, or `ending`
  // says why it is not.
  bool step(Ending& ending);
  // The named host event that starts an external task; false: no task waits for it.
  bool raise(const std::string& event);
  // True when no activation is between its begin and its end.
  bool isIdle() const { return jobs_.empty(); }
  // The periods, the triggers, and the activations of the row that has begun.
  void transfer(StateArchive& archive);
  // The periods of tasks with the same names and intervals go on as in the version before; others begin at `now_ns`.
  void goOnFrom(const Schedule& before, int64_t now_ns);
  // Forgets all activations, also those of the row that has begun, and starts the periods again at `now_ns`: after a
  // reset.
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
  bool hasCompleteJob() const;
  void enterDue();
  // Begins the job that waits at the front, or ends the one that is complete. False: none does.
  bool advance(Ending& ending);
  bool begin(size_t job, Ending& ending);
  bool finish(size_t job, Ending& ending);
  void passTime();
  int64_t firstEnd(int64_t until_ns) const;
  int64_t firstInterrupt(int64_t until_ns);
  void spend(int64_t until_ns);

  Tasks& tasks_;
  rung_context& context_;
  Hsio& hsio_;
  bool others_go_on_;
  std::vector<State> states_;
  bool is_in_row_ = false;
  bool ends_first_ = false;  // what ends now leaves before what becomes due now
  int64_t now_ns_ = 0, end_ns_ = 0;
  std::vector<Release> due_;
  size_t next_due_ = 0;
  std::vector<Release> interrupts_;  // that occurred and have no job yet
  std::vector<Job> jobs_;            // by priority; of equal priority in the order in which they came
};

}  // namespace rung::host
