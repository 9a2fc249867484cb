// SPDX-License-Identifier: Apache-2.0
// The tasks of a program, and one activation of a task: what virtual and real time have in common. The two hosts decide
// when an activation begins and ends; all else is here: the exchange of the image, devices, statistics, the watchdog.
// In: the tables of a module. Out: activations run, and why one did not end well.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "drivers.h"
#include "exchange.h"
#include "forces.h"
#include "scope.h"
#include "served_image.h"
#include "symbols.h"

namespace rung::host {

// How often a start was late by how many microseconds; the last bucket has all that were later.
struct Histogram {
  static constexpr uint32_t kBuckets = 2048;
  uint32_t counts[kBuckets] = {};
  void add(int64_t ns) { ++counts[ns < 0 ? 0 : ns / 1000 < kBuckets ? ns / 1000 : kBuckets - 1]; }
};

// How an activation, a cycle or a run ended.
struct Ending {
  enum Kind : uint8_t { Complete, Faulted, Watchdog, Driver } kind = Complete;
  rung_fault fault{};
  const rung_context* context = nullptr;  // of the activation that faulted
  std::string name;                       // of the task whose watchdog, or of the driver that ended it

  bool isComplete() const { return kind == Complete; }
  static Ending faulted(const rung_context& context) { return {Faulted, context.fault, &context, ""}; }
};

struct Task {
  const rung_task* row = nullptr;
  uint32_t index = 0;
  int64_t interval_ns = 0;
  Variable trigger;
  uint32_t activation = 0;           // that began
  uint32_t too_long = 0;             // activations in a row that exceeded the watchdog time
  bool is_first = true;              // the next activation has no period before it: after a start or a pause
  bool stopped = false;              // by a fault of its own, where the others go on
  rung_fault fault{};                // that stopped it
  std::vector<rung_caller> callers;  // of that fault
  uint32_t caller_count = 0;
  Histogram lateness;        // of its starts
  int64_t latest_start = 0;  // the greatest lateness
};

class Tasks {
 public:
  // `interval_ns` is the period of cyclic tasks without one, and of a row when there is no cyclic task.
  Tasks(const Symbols& symbols, Memory& memory, Drivers& drivers, Forces& forces, int64_t interval_ns);
  // The program sees the states of its tasks from now on. False: a trigger is not a BOOL; `error` has the message.
  bool prepare(std::string& error);

  // The period of a row: that of the fastest cyclic task.
  int64_t rowNs() const { return row_ns_; }
  std::vector<Task>& all() { return tasks_; }
  const std::vector<Task>& all() const { return tasks_; }
  const Task* find(const std::string& name) const;
  const Task* fastest() const { return fastest_ == RUNG_NONE ? nullptr : &tasks_[fastest_]; }
  std::string nameOf(const Task& task) const;

  // What Modbus masters see is exchanged at the borders of all activations.
  void serveImage(ServedImage& image) { served_ = &image; }
  // Before the first activation: the inputs of all devices.
  void readInputs(int64_t now_ns) {
    const std::lock_guard<Exchange> lock(exchange_);
    lost_driver_.clear();
    has_lost_driver_.store(false);
    noteLost(drivers_.readAll(now_ns));
  }
  // The code of an activation, from reading the inputs on: RUNG_FAULT_NONE, or a fault, after which nothing that it
  // wrote leaves. `now_ns` is the time that the program sees, `late_ns` how long after its due time it begins.
  uint8_t begin(Task& task, rung_context& context, int64_t now_ns, int64_t late_ns);
  // Its end: the outputs leave. False: the watchdog says stop.
  bool end(Task& task, rung_context& context, int64_t now_ns, int64_t took_ns);
  // After inputs that others than devices gave; the caller holds the lock of the image. Triggers are forced, too.
  void applyForces() const { forces_.apply(memory_.common()); }
  // The table of forces has changed, or a task has stopped: safe outputs are not forced.
  void noteForces();
  // After a fault, where the other tasks go on: the task stops, with safe values in what it writes.
  void stopOne(Task& task, const rung_context& context);
  // All outputs get their safe values and leave.
  void makeOutputsSafe(int64_t now_ns);
  // The program goes on: they are again what it left.
  void restoreOutputs();
  void countOverruns(Task& task, uint32_t missed) {
    const std::lock_guard<Exchange> lock(exchange_);
    states_[task.index].overruns += missed;
  }
  // The watchdog's limit of one activation, or 0.
  static int64_t limitOf(const Task& task);

  // As at power on: no task has run.
  void switchOn();
  // What has become of the tasks with the same names in the version before.
  void goOnFrom(Tasks& before);
  // After a reset: tasks that a fault stopped run again.
  void restart();

  Exchange& exchange() { return exchange_; }
  Scope& scope() { return scope_; }
  const rung_task_state& stateOf(const Task& task) const { return states_[task.index]; }
  // What has become of the tasks, with their statistics; no activation runs.
  void transfer(StateArchive& archive);
  // A line for each task, `elapsed_ns` after the start.
  std::string statistics(int64_t elapsed_ns);
  // The last driver that failed, or empty. Asked after each activation, so it is quick where none did.
  std::string lostDriver() {
    if (!has_lost_driver_.load(std::memory_order_relaxed)) return {};
    const std::lock_guard<Exchange> lock(exchange_);
    return lost_driver_;
  }

 private:
  void noteLost(const std::string& driver) {
    if (driver.empty()) return;
    lost_driver_ = driver;
    has_lost_driver_.store(true, std::memory_order_relaxed);
  }
  void noteStart(Task& task, int64_t start_ns, int64_t late_ns);
  void noteEnd(Task& task, int64_t took_ns);
  void exchangeServed() {
    const auto force = [](void* tasks) { static_cast<const Tasks*>(tasks)->applyForces(); };
    if (served_ != nullptr) served_->exchange(memory_.common().areas, force, this);
  }
  void forceAfterCode(const rung_context& context);
  bool isSafeOutput(const rung_variable& variable) const;

  const Symbols& symbols_;
  Memory& memory_;
  Drivers& drivers_;
  Forces& forces_;
  Exchange exchange_;
  Scope scope_;
  int64_t row_ns_ = 0;
  uint32_t fastest_ = RUNG_NONE;
  std::vector<Task> tasks_;
  std::vector<rung_task_state> states_;
  std::string lost_driver_;
  std::atomic<bool> has_lost_driver_{false};
  ServedImage* served_ = nullptr;
};

bool readBool(const Variable& variable);

}  // namespace rung::host
