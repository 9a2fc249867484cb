// SPDX-License-Identifier: Apache-2.0
// Tasks as threads in real time: see realtime.h.
#include "realtime.h"

#include <pthread.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>

#include "clock.h"

namespace rung::host {
namespace {

constexpr int64_t kSecond = 1'000'000'000, kMillisecondNs = 1'000'000;
constexpr size_t kPrefaulted = 64 * 1024;  // of each stack

timespec timeOf(int64_t ns) { return {static_cast<time_t>(ns / kSecond), static_cast<long>(ns % kSecond)}; }

void sleepUntil(int64_t ns) {
  const timespec until = timeOf(ns);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

void touchStack() {
  char pages[kPrefaulted];
  for (size_t i = 0; i < kPrefaulted; i += 4096) static_cast<volatile char*>(pages)[i] = 0;
}

// The signals that end a run; threads of tasks do not receive them.
sigset_t endingSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

thread_local Realtime::Place Realtime::place_{};

Realtime::Realtime(Tasks& tasks, rung_context& context, const RealtimeOptions& options, const RealtimeHooks& hooks)
    : tasks_(tasks), options_(options), hooks_(hooks), common_(context) {
  if (context.host != nullptr) host_ = *context.host;
  host_.wait = waitForOthers;
  tick_ns_ = std::min(tasks.rowNs(), kMillisecondNs);
  resources_ = std::max(1u, context.module->resources.count);
  processors_ = std::make_unique<Processor[]>(resources_);
}

Realtime::~Realtime() {
  if (!result_.hung)
    for (const std::unique_ptr<Worker>& worker : workers_) sem_destroy(&worker->event);
}

// Called by a task that waits for a MUTEX or SEMA, so that a task of lower priority may run.
int Realtime::waitForOthers(void*) {
  constexpr int64_t kMoment = 50'000;
  if (place_.host == nullptr || place_.host->stop_.load()) return 0;
  place_.processor->release();
  sleepUntil(monotonicNs() + kMoment);
  place_.processor->acquire(place_.priority);
  return 1;
}

int64_t Realtime::programNs() const { return options_.base_ns + monotonicNs() - start_ns_; }

// The first reason counts. After a signal only a task that did not end by itself is one.
void Realtime::stopBecause(const Ending& ending) {
  const std::lock_guard<PriorityMutex> held(activity_);
  if (result_.ending.isComplete() && (!has_signal_ || ending.fault.kind == RUNG_FAULT_STOP)) result_.ending = ending;
  stop_.store(true);
}

// ---- activations

// One activation; false when the thread must end. `row`: < 0 for tasks that make none. A row comes also where the task
// itself is stopped.
bool Realtime::activate(Worker& worker, int64_t row, int64_t due_ns, int64_t program_ns) {
  Processor& processor = processorOf(worker);
  processor.acquire(worker.task->row->priority);
  bool is_active = false;
  {
    const std::lock_guard<PriorityMutex> held(activity_);
    is_active = !stop_.load() && !paused_.load() && !worker.task->stopped;
    if (is_active) ++active_;
    if (!is_left_) worker.next.fetch_add(1);
  }
  if (!is_active) {
    if (row >= 0 && !stop_.load()) makeRow(row);
    processor.release();
    return !stop_.load();
  }
  const int64_t began_ns = monotonicNs();
  worker.running_since.store(began_ns);
  if (row >= 0) {
    const std::lock_guard<Exchange> lock(tasks_.exchange());
    hooks_.before(row);
    tasks_.applyForces();
  }
  const uint8_t fault = tasks_.begin(*worker.task, worker.context, program_ns, std::max<int64_t>(0, began_ns - due_ns));
  const bool goes_on = complete(worker, fault, began_ns, program_ns, row);
  processor.release();
  return goes_on;
}

void Realtime::makeRow(int64_t row) {
  const std::lock_guard<std::mutex> rest(rest_);
  {
    const std::lock_guard<Exchange> lock(tasks_.exchange());
    hooks_.before(row);
  }
  hooks_.after(row);
}

bool Realtime::complete(Worker& worker, uint8_t fault, int64_t began_ns, int64_t program_ns, int64_t row) {
  bool goes_on = true;
  const bool waited = fault == RUNG_FAULT_LOCK && stop_.load();  // it was waiting when the run ended
  const int64_t now_ns = monotonicNs();
  if (fault == RUNG_FAULT_NONE) {
    goes_on = tasks_.end(*worker.task, worker.context, program_ns, now_ns - began_ns);
    if (!goes_on) stopBecause({Ending::Watchdog, {}, nullptr, tasks_.nameOf(*worker.task)});
  } else if (options_.others_go_on && fault != RUNG_FAULT_STOP) {
    tasks_.stopOne(*worker.task, worker.context);
  } else {
    if (!waited) stopBecause(Ending::faulted(worker.context));
    goes_on = false;
  }
  const std::string lost = tasks_.lostDriver();
  if (!lost.empty()) stopBecause({Ending::Driver, {}, nullptr, lost});
  worker.running_since.store(0);
  if (row >= 0 && fault == RUNG_FAULT_NONE) hooks_.after(row);
  const std::lock_guard<PriorityMutex> held(activity_);
  if (--active_ == 0 && result_.ending.isComplete() && hooks_.complete) {
    hooks_.complete(program_ns);
    complete_ns_ = now_ns;
  }
  return goes_on && !stop_.load();
}

// A start that comes while the task still runs is dropped and counted; the grid of its periods stays.
void Realtime::runCyclic(Worker& worker) {
  const int64_t interval = worker.task->interval_ns;
  const bool makes_rows = worker.task == tasks_.fastest();
  while (!stop_.load()) {
    const int64_t n = worker.next.load(), due = start_ns_ + n * interval, row = first_row_ + n - worker.first;
    sleepUntil(due);
    if (stop_.load() || !activate(worker, makes_rows ? row : -1, due, options_.base_ns + n * interval)) return;
    if (makes_rows) {
      rows_done_.store(row + 1);
      if (options_.rows >= 0 && row + 1 >= options_.rows) stop_.store(true);
    }
    const int64_t missed = (monotonicNs() - due) / interval;
    if (missed <= 0) continue;
    tasks_.countOverruns(*worker.task, static_cast<uint32_t>(missed));
    worker.next.fetch_add(missed);
    if (makes_rows && options_.rows >= 0 && row + missed + 1 >= options_.rows) {
      rows_done_.store(options_.rows);
      stop_.store(true);
    }
  }
}

// It rests for a moment between its turns, so that tasks of lower priority are not starved.
void Realtime::runFreewheeling(Worker& worker) {
  for (int64_t next = std::max(start_ns_, monotonicNs()); !stop_.load(); next = monotonicNs() + tick_ns_) {
    sleepUntil(next);
    const int64_t now = monotonicNs();
    if (stop_.load() || !activate(worker, -1, now, options_.base_ns + now - start_ns_)) return;
  }
}

void Realtime::runOnEvent(Worker& worker) {
  for (;;) {
    while (sem_wait(&worker.event) != 0 && errno == EINTR) {
    }
    if (stop_.load()) return;
    const int64_t due = worker.due_ns.load();
    const bool goes_on = activate(worker, -1, due, options_.base_ns + due - start_ns_);
    const uint32_t missed = worker.missed.exchange(0);
    tasks_.countOverruns(*worker.task, missed);
    worker.is_posted.store(false);
    if (!goes_on) return;
  }
}

void Realtime::post(Worker& worker, int64_t due_ns) {
  if (worker.is_posted.exchange(true)) {
    worker.missed.fetch_add(1);
    return;
  }
  worker.due_ns.store(due_ns);
  sem_post(&worker.event);
}

bool Realtime::isDue(Worker& worker, int64_t now_ns) {
  const Task& task = *worker.task;
  const bool is_true = readBool(task.trigger), was_true = worker.was_true;
  worker.was_true = is_true;
  if (task.row->kind == RUNG_STATUS) return is_true && !worker.is_posted.load();
  bool due = is_true && !was_true;
  if (task.row->interval_ns > 0 && now_ns >= worker.next_ns) {
    worker.next_ns += ((now_ns - worker.next_ns) / task.row->interval_ns + 1) * task.row->interval_ns;
    due = due || !is_true;
  }
  return due;
}

// The triggers of a resource: one thread looks at all of them at each tick.
void Realtime::sample(uint32_t resource) {
  processors_[resource].join(0, true);
  if (!waitForStart()) return;
  for (int64_t next = std::max(start_ns_, monotonicNs()); !stop_.load();
       next = std::max(next + tick_ns_, monotonicNs())) {
    sleepUntil(next);
    const std::lock_guard<std::mutex> rest(rest_);
    if (paused_.load() || stop_.load()) continue;
    for (const std::unique_ptr<Worker>& worker : workers_) {
      const uint8_t kind = worker->task->row->kind;
      if (worker->task->row->resource != resource || (kind != RUNG_EVENT && kind != RUNG_STATUS)) continue;
      if (worker->task->trigger.type != nullptr && isDue(*worker, next)) post(*worker, next);
    }
  }
}

bool Realtime::raise(const std::string& event) {
  bool found = false;
  for (const std::unique_ptr<Worker>& worker : workers_) {
    const rung_task& row = *worker->task->row;
    if (row.kind != RUNG_EXTERNAL || event != common_.module->strings + row.external_event) continue;
    found = true;
    post(*worker, monotonicNs());
  }
  return found;
}

// ---- threads

void Realtime::createWorkers() {
  for (Task& task : tasks_.all()) {
    auto worker = std::make_unique<Worker>();
    worker->task = &task;
    sem_init(&worker->event, 0, 0);
    workers_.push_back(std::move(worker));
  }
}

void Realtime::goOnFrom(const Realtime& before) {
  start_ns_ = before.start_ns_;
  first_row_ = before.rows_done_.load();
  rows_done_.store(first_row_);
  paused_.store(before.paused_.load());
  const int64_t now_ns = monotonicNs();
  for (const std::unique_ptr<Worker>& worker : workers_) {
    const int64_t interval = std::max<int64_t>(worker->task->interval_ns, 1);
    worker->next.store((now_ns - start_ns_ + interval - 1) / interval);
    for (const std::unique_ptr<Worker>& was : before.workers_)
      if (before.tasks_.nameOf(*was->task) == tasks_.nameOf(*worker->task)) goOnFrom(*was, *worker);
    worker->first = worker->next.load();
  }
}

// The next activation is the one that has not begun; what triggered it counts.
void Realtime::goOnFrom(const Worker& before, Worker& worker) const {
  worker.was_true = before.was_true;
  worker.next_ns = before.next_ns;
  if (before.task->interval_ns == worker.task->interval_ns) worker.next.store(before.next.load());
  worker.due_ns.store(before.due_ns.load());
  worker.is_posted.store(before.is_posted.load());
  if (worker.is_posted.load()) sem_post(&worker.event);
}

// False: the run ends before it begins.
bool Realtime::waitForStart() {
  std::unique_lock<std::mutex> lock(start_mutex_);
  start_condition_.wait(lock, [&] { return started_; });
  return !stop_.load();
}

// All threads take their priority and wait for the common start, the alignment point of all periods.
void Realtime::startThreads() {
  bool has_triggers = false;
  for (const std::unique_ptr<Worker>& worker : workers_) {
    const uint8_t kind = worker->task->row->kind;
    has_triggers = has_triggers || kind == RUNG_EVENT || kind == RUNG_STATUS;
    live_.fetch_add(1);
    worker->thread = std::thread([this, &worker = *worker] {
      touchStack();
      runWorker(worker);
      live_.fetch_sub(1);
    });
  }
  for (uint32_t i = 0; has_triggers && i < resources_; ++i) {
    live_.fetch_add(1);
    samplers_.emplace_back([this, i] {
      sample(i);
      live_.fetch_sub(1);
    });
  }
}

void Realtime::runWorker(Worker& worker) {
  place_ = {this, &processorOf(worker), worker.task->row->priority};
  place_.processor->join(place_.priority);
  if (!waitForStart()) return;
  switch (static_cast<rung_task_kind>(worker.task->row->kind)) {
    case RUNG_CYCLIC: return runCyclic(worker);
    case RUNG_FREEWHEELING: return runFreewheeling(worker);
    case RUNG_EVENT:
    case RUNG_STATUS:
    case RUNG_EXTERNAL: return runOnEvent(worker);
  }
}

// The threads wait.
void Realtime::prepare() {
  for (uint32_t i = 0; i < resources_; ++i) processors_[i].prepare(i, rights_);
  createWorkers();
  startThreads();
  is_prepared_ = true;
}

void Realtime::begin(const Realtime* before) {
  const std::lock_guard<std::mutex> lock(start_mutex_);
  for (const std::unique_ptr<Worker>& worker : workers_) {
    worker->context = common_;
    worker->context.host = &host_;
  }
  if (before != nullptr) {
    goOnFrom(*before);
  } else {
    start_ns_ = monotonicNs() + kMillisecondNs + static_cast<int64_t>(workers_.size()) * 50'000;
    for (const std::unique_ptr<Worker>& worker : workers_) worker->next_ns = start_ns_;
  }
  started_ = true;
  start_condition_.notify_all();
}

std::unique_ptr<Realtime> Realtime::successor(Tasks& tasks, rung_context& context) const {
  auto next = std::make_unique<Realtime>(tasks, context, options_, hooks_);
  next->rights_ = rights_;
  next->caller_ = caller_;
  next->prepare();
  return next;
}

void Realtime::leaveTo(Realtime& next) {
  is_left_ = true;
  stop_.store(true);
  next.begin(this);
}

void Realtime::abandon() {
  stop_.store(true);
  {
    const std::lock_guard<std::mutex> lock(start_mutex_);
    started_ = true;
    start_condition_.notify_all();
  }
  join();
}

void Realtime::beAtEase() {
  caller_.restore();
  is_at_ease_ = true;
}

// The caller's thread never waits for tasks.
void Realtime::beAbove() {
  processors_[0].join(0, true);
  is_at_ease_ = false;
}

// Asks tasks that still run a moment after the end to stop (rung_poll). False: one does not.
bool Realtime::endActivations(uint8_t reason) {
  const int64_t begin = monotonicNs();
  const auto runs = [](const std::unique_ptr<Worker>& worker) { return worker->running_since.load() != 0; };
  while (std::any_of(workers_.begin(), workers_.end(), runs)) {
    const int64_t now = monotonicNs();
    if (now - begin > 2 * kSecond) return false;
    if (now - begin >= kSecond || reason == RUNG_STOP_TIME)
      for (const std::unique_ptr<Worker>& worker : workers_) worker->context.stop = reason;
    sleepUntil(now + 2 * kMillisecondNs);
  }
  return true;
}

bool Realtime::isTooLong() {
  const std::lock_guard<PriorityMutex> held(activity_);
  const Ending& ending = result_.ending;
  const bool out_of_time = ending.kind == Ending::Faulted && ending.fault.kind == RUNG_FAULT_STOP;
  return out_of_time || ending.kind == Ending::Watchdog;
}

// ---- the caller's thread

// Tasks that do not end by themselves.
void Realtime::watch(int64_t now_ns) {
  if (options_.timeout_ns > 0 && now_ns - start_ns_ >= options_.timeout_ns) {
    stopBecause({Ending::Faulted, {RUNG_FAULT_STOP, RUNG_NONE, RUNG_STOP_TIME}, nullptr, ""});
  }
  for (const std::unique_ptr<Worker>& worker : workers_) {
    const int64_t since = worker->running_since.load(), limit = Tasks::limitOf(*worker->task);
    if (since == 0 || limit <= 0 || now_ns - since <= limit) continue;
    stopBecause({Ending::Watchdog, {}, nullptr, tasks_.nameOf(*worker->task)});
    worker->context.stop = RUNG_STOP_TIME;
  }
}

// Where some task is always within an activation, all rest for a moment once a second.
void Realtime::makeComplete(int64_t now_ns) {
  if (!hooks_.complete || paused_.load()) return;
  {
    const std::lock_guard<PriorityMutex> held(activity_);
    if (now_ns - std::max(complete_ns_, start_ns_) < kSecond) return;
  }
  if (pause()) {
    const std::lock_guard<PriorityMutex> held(activity_);
    hooks_.complete(programNs());
    complete_ns_ = now_ns;
  }
  resume();
}

// How often the supervisor looks: as often as the host and the shortest watchdog need, and not more, for each look
// costs a switch of threads.
int64_t Realtime::pollNs() const {
  int64_t poll = options_.poll_ns;
  for (const std::unique_ptr<Worker>& worker : workers_)
    if (const int64_t watchdog = worker->task->row->watchdog_ns; watchdog > 0) poll = std::min(poll, watchdog / 2);
  return std::max(poll, kMillisecondNs);
}

// Makes the rows when no cyclic task does, and waits for signals.
void Realtime::supervise() {
  const sigset_t signals = endingSignals();
  const bool makes_rows = tasks_.fastest() == nullptr;
  const int64_t poll = makes_rows ? tasks_.rowNs() : pollNs();
  int64_t row = first_row_;
  for (int64_t next = std::max(start_ns_, monotonicNs()) + poll; !stop_.load();
       next = std::max(next + poll, monotonicNs())) {
    if (makes_rows) {
      const std::lock_guard<Exchange> lock(tasks_.exchange());
      hooks_.before(row);
      if (!paused_.load()) tasks_.applyForces();
    }
    const timespec wait = timeOf(std::max<int64_t>(0, next - monotonicNs()));
    if (sigtimedwait(&signals, nullptr, &wait) > 0) {
      const std::lock_guard<PriorityMutex> held(activity_);
      has_signal_ = true;
      return;
    }
    if (makes_rows) {
      hooks_.after(row);
      rows_done_.store(++row);
      if (options_.rows >= 0 && row >= options_.rows) return;
    }
    watch(monotonicNs());
    makeComplete(monotonicNs());
    hooks_.idle();
    if (is_at_ease_ && !stop_.load()) beAbove();
  }
}

bool Realtime::pause() {
  paused_.store(true);
  const int64_t begin = monotonicNs();
  for (;;) {
    {
      const std::lock_guard<PriorityMutex> held(activity_);
      if (active_ == 0) return true;
    }
    if (monotonicNs() - begin > kSecond) return false;
    sleepUntil(monotonicNs() + kMillisecondNs);
  }
}

// Where some task is always within an activation, all rest for a moment.
bool Realtime::between(const std::function<void()>& act) {
  const bool was_at_ease = is_at_ease_;
  if (was_at_ease) beAbove();
  const bool is_done = findMoment(act);
  if (was_at_ease) beAtEase();
  return is_done;
}

bool Realtime::findMoment(const std::function<void()>& act) {
  constexpr int64_t kPatienceNs = 100 * kMillisecondNs, kMomentNs = 20'000;
  for (const int64_t begin = monotonicNs(); monotonicNs() - begin < kPatienceNs;
       sleepUntil(monotonicNs() + kMomentNs)) {
    const std::unique_lock<std::mutex> resting = rest();  // in this order, as cycle() does
    const std::lock_guard<PriorityMutex> held(activity_);
    if (active_ > 0) continue;
    act();
    return true;
  }
  const bool was_paused = paused_.load(), is_quiet = pause();
  if (is_quiet) {
    const std::unique_lock<std::mutex> resting = rest();
    act();
  }
  paused_.store(was_paused);
  return is_quiet;
}

bool Realtime::cycle() {
  std::vector<Worker*> order;
  for (const std::unique_ptr<Worker>& worker : workers_) {
    const uint8_t kind = worker->task->row->kind;
    if ((kind == RUNG_CYCLIC || kind == RUNG_FREEWHEELING) && !worker->task->stopped) order.push_back(worker.get());
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Worker* a, const Worker* b) { return a->task->row->priority < b->task->row->priority; });
  for (Worker* const worker : order) {
    {
      const std::lock_guard<PriorityMutex> held(activity_);
      ++active_;
    }
    const int64_t began = monotonicNs(), now = programNs();
    const uint8_t fault = tasks_.begin(*worker->task, worker->context, now, 0);
    if (!complete(*worker, fault, began, now, -1)) return false;
  }
  return true;
}

void Realtime::join() {
  for (std::thread& sampler : samplers_)
    if (sampler.joinable()) sampler.join();
  for (const std::unique_ptr<Worker>& worker : workers_) {
    if (!worker->thread.joinable()) continue;
    if (result_.hung && worker->running_since.load() != 0)
      worker->thread.detach();  // the task never ends; the process will
    else
      worker->thread.join();
  }
}

RealtimeResult Realtime::runAfter(const Realtime& before) {
  begin(&before);
  return run();
}

RealtimeResult Realtime::run() {
  const sigset_t signals = endingSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  if (!is_prepared_) {
    rights_ = findRights();
    prepare();
  }
  beAbove();
  if (!started_) begin(nullptr);
  result_.missing = rights_.missing;
  live_.fetch_add(1);
  supervise();
  live_.fetch_sub(1);
  stop_.store(true);
  for (const std::unique_ptr<Worker>& worker : workers_) sem_post(&worker->event);
  result_.is_left = is_left_;
  result_.rows = rows_done_.load();
  if (is_left_) return result_;  // with the signals and the priority of this thread as the next threads need them
  // A second signal ends the process at once.
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  result_.hung = !endActivations(isTooLong() ? RUNG_STOP_TIME : RUNG_STOP_INTERRUPT);
  result_.elapsed_ns = monotonicNs() - start_ns_;
  join();
  caller_.restore();
  result_.rows = rows_done_.load();
  if (result_.hung)
    for (std::unique_ptr<Worker>& worker : workers_) (void)worker.release();  // detached threads still use them
  return result_;
}

}  // namespace rung::host
