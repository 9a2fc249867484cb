// SPDX-License-Identifier: Apache-2.0
// Real time: a thread per task with absolute deadlines, on the processor of its resource. What an activation does is in
// tasks.h; here is when it begins. In: the tasks and the hooks of a run. Out: why the run ended. Stops at SIGINT and
// SIGTERM: the activations that run are completed.
#pragma once

#include <semaphore.h>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "priority_mutex.h"
#include "processor.h"
#include "tasks.h"

namespace rung::host {

struct RealtimeOptions {
  int64_t rows = -1;             // < 0: until a signal arrives or the time is over
  int64_t timeout_ns = 0;        // 0: none
  int64_t base_ns = 0;           // the program's time at the start
  bool others_go_on = false;     // a fault stops its task alone
  int64_t poll_ns = 50'000'000;  // at most, between calls of RealtimeHooks::idle
};

struct RealtimeHooks {
  // The run has ended with a fault. True: another version goes on instead (Session::goBack). May be empty.
  std::function<bool(const Ending& ending)> go_back;
  // In the thread of the fastest cyclic task, around its activation. Rows whose start was missed have none.
  std::function<void(int64_t row)> before, after;
  // When no task is within an activation: what is kept is that of complete cycles. May be empty.
  std::function<void(int64_t program_ns)> complete;
  // In the caller's thread, at least every RealtimeOptions::poll_ns.
  std::function<void()> idle;
};

struct RealtimeResult {
  Ending ending;  // Faulted without a context: the time is over
  int64_t rows = 0;
  bool hung = false;     // a thread is still inside the program: it could not be ended
  bool is_left = false;  // another version takes over (leave)
  std::string missing;   // rights, for the user
  int64_t elapsed_ns = 0;
};

class Realtime {
 public:
  Realtime(Tasks& tasks, rung_context& context, const RealtimeOptions& options, const RealtimeHooks& hooks);
  // The threads of another version: they wait until this one gives way, and go on with its grid of time and its rows.
  std::unique_ptr<Realtime> successor(Tasks& tasks, rung_context& context) const;
  ~Realtime();
  Realtime(const Realtime&) = delete;
  Realtime& operator=(const Realtime&) = delete;

  RealtimeResult run();
  // After the end of the one before: this one goes on.
  RealtimeResult runAfter(const Realtime& before);
  // For what takes time: until the hook `idle` returns, the caller's thread has the priority that it had before run(),
  // except in `between`.
  void beAtEase();

  // A user may ask this of the running program; called from the hook `idle`.
  // Lets the activations that run end, and begins no others. False: one did not end within a second.
  bool pause();
  void resume() { paused_.store(false); }
  // Calls `act` where no activation runs, and keeps others from beginning meanwhile. False: there was no such moment
  // within a second.
  bool between(const std::function<void()>& act);
  // One activation of every task that no event starts, by priority; only while paused. False: the run ends.
  bool cycle();
  // The named host event that starts external tasks; false: no task waits for it.
  bool raise(const std::string& event);
  void end() { stop_.store(true); }
  // From `between`: no activation begins any more, the threads of `next` go on, and run() returns at once. Threads that
  // sleep still use the tasks and the context until join() has returned.
  void leaveTo(Realtime& next);
  // Of threads that wait to go on: they end.
  void abandon();
  void join();
  // Of threads that were left: none sleeps any more, nor is run() under way.
  bool hasEnded() const { return live_.load() == 0; }
  // While paused, rows go on; none is made, and no trigger is looked at, while one holds this.
  std::unique_lock<std::mutex> rest() { return std::unique_lock<std::mutex>(rest_); }
  int64_t programNs() const;
  int64_t rowsDone() const { return rows_done_.load(); }

 private:
  struct Worker {
    Task* task = nullptr;
    rung_context context{};                 // shares the memory, has its own time and fault
    std::atomic<int64_t> running_since{0};  // 0: not within an activation
    std::atomic<int64_t> due_ns{0};         // of an event that was posted
    std::atomic<bool> is_posted{false};
    std::atomic<uint32_t> missed{0};
    bool was_true = false;  // of the trigger, in the thread that samples
    int64_t next_ns = 0;    // event tasks that are also periodic
    // Of a cyclic task: the number of its next activation on the grid of its periods, and of the first here.
    std::atomic<int64_t> next{0};
    int64_t first = 0;
    sem_t event;
    std::thread thread;
  };
  // A thread that waits for a MUTEX or SEMA leaves this and takes it up again.
  struct Place {
    Realtime* host;
    Processor* processor;
    uint32_t priority;
  };
  static thread_local Place place_;
  static int waitForOthers(void*);

  void prepare();
  void createWorkers();
  void startThreads();
  void goOnFrom(const Realtime& before);
  void goOnFrom(const Worker& before, Worker& worker) const;
  void begin(const Realtime* before);
  bool waitForStart();
  void runWorker(Worker& worker);
  Processor& processorOf(const Worker& worker) { return processors_[worker.task->row->resource]; }
  void runCyclic(Worker& worker);
  void runFreewheeling(Worker& worker);
  void runOnEvent(Worker& worker);
  void sample(uint32_t resource);
  bool isDue(Worker& worker, int64_t now_ns);
  void post(Worker& worker, int64_t due_ns);
  void makeRow(int64_t row);
  bool activate(Worker& worker, int64_t row, int64_t due_ns, int64_t program_ns);
  bool complete(Worker& worker, uint8_t fault, int64_t began_ns, int64_t program_ns, int64_t row);
  void stopBecause(const Ending& ending);
  void watch(int64_t now_ns);
  void makeComplete(int64_t now_ns);
  bool endActivations(uint8_t reason);
  bool isTooLong();
  int64_t pollNs() const;
  void supervise();
  void beAbove();
  bool findMoment(const std::function<void()>& act);

  Tasks& tasks_;
  const RealtimeOptions options_;
  const RealtimeHooks hooks_;
  rung_context& common_;
  rung_host host_{};
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<std::thread> samplers_;
  std::unique_ptr<Processor[]> processors_;
  Rights rights_;
  Scheduling caller_;  // of the thread that calls run(), before it
  bool is_at_ease_ = false;
  uint32_t resources_ = 1;
  int64_t tick_ns_ = 1'000'000;
  int64_t start_ns_ = 0;
  int64_t first_row_ = 0;
  bool is_left_ = false;  // guarded by activity_

  std::atomic<bool> stop_{false}, paused_{false};
  std::atomic<uint32_t> live_{0};  // threads of tasks and triggers, and the caller's in run()
  std::atomic<int64_t> rows_done_{0};
  std::mutex start_mutex_;
  std::condition_variable start_condition_;
  bool started_ = false;
  bool is_prepared_ = false;  // there are threads
  std::mutex rest_;
  PriorityMutex activity_;   // guards the next two
  uint32_t active_ = 0;      // activations between begin and end
  int64_t complete_ns_ = 0;  // when the hook was called last; also guarded
  bool has_signal_ = false;  // a signal has ended the run; also guarded
  RealtimeResult result_;
};

}  // namespace rung::host
