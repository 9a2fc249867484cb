// SPDX-License-Identifier: Apache-2.0
// The processor of a resource: the right to run its tasks. Where the system lets a thread choose SCHED_FIFO and a CPU,
// all tasks of a resource are on one CPU, and the system interrupts a task for one of higher priority; else they run
// one at a time, and of those that wait the one of highest priority is next. In: threads of tasks. Called by
// realtime.cpp.
#pragma once

#include <sched.h>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace rung::host {

// The rights that the system gives. The reason is a sentence for the user, empty where nothing is missing.
struct Rights {
  bool preemptive = false;  // SCHED_FIFO and the choice of a CPU
  std::string missing;
  std::vector<int> cpus;  // that the calling thread may use
};
Rights findRights();
// How the calling thread is scheduled, to return to it.
class Scheduling {
 public:
  Scheduling();
  void restore() const;

 private:
  int policy_ = SCHED_OTHER;
  sched_param priority_{};
  cpu_set_t cpus_{};
};
// The calling thread serves others: it yields to them, and stays off the CPUs of so many resources where there are
// more.
void yieldToTasks(uint32_t resources);

class Processor {
 public:
  // `number`: of the resource; each has a CPU of its own while there are enough.
  void prepare(uint32_t number, const Rights& rights);
  // For the thread of a task, once: its priority (0 highest) and its CPU. `above`: for threads that must never wait for
  // tasks.
  void join(uint32_t priority, bool above = false) const;
  void acquire(uint32_t priority);
  void release();

 private:
  static constexpr uint32_t kPriorities = 32;
  bool preemptive_ = false;
  int cpu_ = 0;
  std::mutex mutex_;
  bool is_busy_ = false;
  uint32_t waiting_[kPriorities] = {};
  std::condition_variable free_[kPriorities];
};

}  // namespace rung::host
