// Tasks as threads in real time: see realtime.h.
#include "realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <ctime>
#include <memory>
#include <mutex>
#include <thread>

#include "crashes.h"
namespace rung::host {
namespace {

constexpr int64_t kSecond = 1'000'000'000;
volatile sig_atomic_t signalled = 0;
void onSignal(int) { signalled = 1; }

int64_t monotonicNs() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

void sleepUntil(int64_t ns) {
  const timespec until = {static_cast<time_t>(ns / kSecond), static_cast<long>(ns % kSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0 && signalled == 0) {
  }
}

struct Worker {
  const Schedule::Item* item;
  rung_context context;  // shares the memory, has its own time and fault
  bool makes_rows = false;
  std::atomic<int64_t> running_since{0};  // 0: idle
  int64_t activations = 0, skipped = 0, overruns_in_a_row = 0;
  int64_t worst_late_ns = 0, longest_run_ns = 0;
  std::thread thread;
};

struct Shared {
  std::atomic<bool> stop{false};
  std::atomic<int64_t> rows_done{0};
  int64_t rows, start;
  std::mutex mutex;  // guards the result
  RealtimeResult result;
  const std::function<void(int64_t)>*before, *after;
};

std::atomic<Shared*> running_host{nullptr};  // for callbacks that only have the program's context

// Called by a task that waits for a MUTEX or SEMA. Sleeps, so a task of lower priority may run.
int waitForOthers(void*) {
  constexpr int64_t kMoment = 50'000;
  const Shared* const shared = running_host.load();
  if (shared == nullptr || shared->stop.load()) return 0;
  sleepUntil(monotonicNs() + kMoment);
  return 1;
}

// Priority 0 is the highest of 32; without the right to use SCHED_FIFO nothing changes.
void raisePriority(uint32_t priority) {
  sched_param parameters{};
  parameters.sched_priority = std::max(1, 80 - 2 * static_cast<int>(std::min(priority, 31u)));
  pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

// One activation with its watchdog; false when the run must stop.
bool activate(Shared& shared, Worker& worker, int64_t now_ns) {
  const int64_t begin = monotonicNs();
  worker.running_since.store(begin);
  worker.context.now_ns = now_ns;
  worker.context.entry = worker.item->task;
  ++worker.context.activation;
  const uint8_t fault = guarded(&worker.context, worker.item->task->run);
  worker.running_since.store(0);
  const int64_t took = monotonicNs() - begin;
  worker.longest_run_ns = std::max(worker.longest_run_ns, took);
  ++worker.activations;
  if (fault == RUNG_FAULT_LOCK && shared.stop.load()) return false;  // it was waiting when the run ended
  if (fault != RUNG_FAULT_NONE) {
    const std::lock_guard<std::mutex> lock(shared.mutex);
    if (!shared.result.faulted || fault == RUNG_FAULT_STOP) shared.result.fault = worker.context.fault;
    shared.result.faulted = true;
    shared.stop.store(true);
    return false;
  }
  // Too long `sensitivity` times in a row stops the run; tasks that never end are noticed by the caller's thread.
  const int64_t limit = worker.item->task->watchdog_ns;
  worker.overruns_in_a_row = limit > 0 && took > limit ? worker.overruns_in_a_row + 1 : 0;
  if (limit > 0 && worker.overruns_in_a_row >= std::max<int64_t>(1, worker.item->task->sensitivity)) {
    const std::lock_guard<std::mutex> lock(shared.mutex);
    shared.result.watchdog = worker.context.module->strings + worker.item->task->name;
    shared.stop.store(true);
    return false;
  }
  return true;
}

void runCyclic(Shared& shared, Worker& worker) {
  const int64_t interval = worker.item->interval_ns;
  for (int64_t n = 0; !shared.stop.load(); ++n) {
    const int64_t deadline = shared.start + n * interval;
    sleepUntil(deadline);
    if (shared.stop.load()) return;
    const int64_t late = monotonicNs() - deadline;
    worker.worst_late_ns = std::max(worker.worst_late_ns, late);
    if (worker.makes_rows) (*shared.before)(n);
    if (!activate(shared, worker, n * interval)) return;
    if (worker.makes_rows) {
      (*shared.after)(n);
      shared.rows_done.store(n + 1);
      if (shared.rows >= 0 && n + 1 >= shared.rows) shared.stop.store(true);
    } else {
      // A missed start is skipped and counted; the task that makes rows catches up instead, so no row is lost.
      const int64_t missed = (monotonicNs() - deadline) / interval;
      if (missed > 0) {
        worker.skipped += missed;
        n += missed;
      }
    }
  }
}

void runOnCondition(Shared& shared, Worker& worker, int64_t poll_ns) {
  bool was_true = false;
  for (int64_t next = shared.start; !shared.stop.load(); next = std::max(next + poll_ns, monotonicNs())) {
    sleepUntil(next);
    bool due = worker.item->task->kind == RUNG_FREEWHEELING;
    if (!due && worker.item->trigger.type != nullptr) {
      const bool is_true = readBool(worker.item->trigger);
      due = is_true && (worker.item->task->kind == RUNG_STATUS || !was_true);
      was_true = is_true;
    }
    if (due && !shared.stop.load() && !activate(shared, worker, monotonicNs() - shared.start)) return;
  }
}

// Asks tasks that still run a moment after the end to stop (rung_poll). False: one does not.
bool endTasks(const std::vector<std::unique_ptr<Worker>>& workers, uint8_t reason) {
  const int64_t begin = monotonicNs();
  const auto runs = [](const std::unique_ptr<Worker>& worker) { return worker->running_since.load() != 0; };
  while (std::any_of(workers.begin(), workers.end(), runs)) {
    const int64_t now = monotonicNs();
    if (now - begin > 2 * kSecond) return false;
    if (now - begin >= kSecond)
      for (const std::unique_ptr<Worker>& worker : workers) worker->context.stop = reason;
    sleepUntil(now + 5'000'000);
  }
  return true;
}

std::string microseconds(int64_t ns) { return std::to_string((ns + 500) / 1000) + " us"; }

}  // namespace

RealtimeResult runRealtime(Schedule& schedule, rung_context& context, int64_t rows, int64_t timeout_ns,
                           const std::function<void(int64_t)>& before, const std::function<void(int64_t)>& after,
                           const std::function<void()>& idle) {
  Shared shared;
  shared.rows = rows;
  shared.before = &before;
  shared.after = &after;
  rung_host host = context.host != nullptr ? *context.host : rung_host{};
  host.wait = waitForOthers;
  running_host.store(&shared);
  signalled = 0;
  struct sigaction action {
  }, old_interrupt{}, old_terminate{};
  action.sa_handler = onSignal;
  sigaction(SIGINT, &action, &old_interrupt);
  sigaction(SIGTERM, &action, &old_terminate);
  mlockall(MCL_CURRENT | MCL_FUTURE);  // where permitted

  std::vector<std::unique_ptr<Worker>> workers;
  Worker* fastest = nullptr;
  for (const Schedule::Item& item : schedule.items()) {
    auto worker = std::make_unique<Worker>();
    worker->item = &item;
    worker->context = context;
    worker->context.host = &host;
    worker->context.task = static_cast<uint32_t>(workers.size()) + 1;
    worker->context.activation = 0;
    if (item.task->kind == RUNG_CYCLIC && (fastest == nullptr || item.interval_ns < fastest->item->interval_ns))
      fastest = worker.get();
    workers.push_back(std::move(worker));
  }
  if (fastest != nullptr) fastest->makes_rows = true;
  shared.start = monotonicNs() + 1'000'000;
  for (const std::unique_ptr<Worker>& worker : workers) {
    if (worker->item->task->kind == RUNG_EXTERNAL) continue;
    worker->thread = std::thread([&shared, &worker = *worker, &schedule] {
      raisePriority(worker.item->task->priority);
      if (worker.item->task->kind == RUNG_CYCLIC)
        runCyclic(shared, worker);
      else
        runOnCondition(shared, worker, std::min<int64_t>(schedule.rowNs(), 1'000'000));
    });
  }

  // This thread makes the rows when no cyclic task does, and watches for signals and for tasks that never end.
  int64_t next_idle = shared.start + kSecond, row = 0;
  bool hung = false, out_of_time = false;
  while (!shared.stop.load() && !hung) {
    const int64_t poll = fastest != nullptr ? std::min<int64_t>(schedule.rowNs(), 10'000'000) : schedule.rowNs();
    if (fastest == nullptr) {
      sleepUntil(shared.start + row * schedule.rowNs());
      before(row);
      after(row);
      shared.rows_done.store(++row);
      if (rows >= 0 && row >= rows) break;
    } else {
      sleepUntil(monotonicNs() + poll);
    }
    if (signalled != 0) break;
    const int64_t now = monotonicNs();
    if (timeout_ns > 0 && now - shared.start >= timeout_ns) {
      const std::lock_guard<std::mutex> lock(shared.mutex);
      shared.result.fault = {RUNG_FAULT_STOP, RUNG_NONE, RUNG_STOP_TIME};
      shared.result.faulted = out_of_time = true;
      break;
    }
    for (const std::unique_ptr<Worker>& worker : workers) {
      const int64_t since = worker->running_since.load();
      const int64_t limit = worker->item->task->watchdog_ns * std::max<int64_t>(1, worker->item->task->sensitivity);
      if (since == 0 || limit <= 0 || now - since <= limit) continue;
      const std::lock_guard<std::mutex> lock(shared.mutex);
      shared.result.watchdog = context.module->strings + worker->item->task->name;
      hung = true;
    }
    if (now >= next_idle) {
      next_idle = now + kSecond;
      idle();
    }
  }
  shared.stop.store(true);
  if (!hung && (signalled != 0 || out_of_time)) {
    hung = !endTasks(workers, out_of_time ? RUNG_STOP_TIME : RUNG_STOP_INTERRUPT);
    shared.result.hung = hung;
  }
  for (const std::unique_ptr<Worker>& worker : workers) {
    if (!worker->thread.joinable()) continue;
    if (hung && worker->running_since.load() != 0)
      worker->thread.detach();  // the task never ends; the process will
    else
      worker->thread.join();
  }
  running_host.store(nullptr);
  sigaction(SIGINT, &old_interrupt, nullptr);
  sigaction(SIGTERM, &old_terminate, nullptr);

  shared.result.rows = shared.rows_done.load();
  for (const std::unique_ptr<Worker>& worker : workers) {
    if (worker->item->task->kind != RUNG_CYCLIC) continue;
    const char* const name = context.module->strings + worker->item->task->name;
    shared.result.statistics +=
        std::string("task ") + (*name != 0 ? name : "(default)") + ": " + std::to_string(worker->activations) +
        " activations, " + std::to_string(worker->skipped) + " skipped, latest start " +
        microseconds(worker->worst_late_ns) + " late, longest run " + microseconds(worker->longest_run_ns) + '\n';
  }
  if (hung)
    for (std::unique_ptr<Worker>& worker : workers) (void)worker.release();  // detached threads still use them
  return shared.result;
}

}  // namespace rung::host
