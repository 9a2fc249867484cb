// SPDX-License-Identifier: Apache-2.0
// `rung run` and executables of `rung build`: runs a module in virtual or real time. See rung/host.h.
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "call_trace.h"
#include "channels.h"
#include "clock.h"
#include "commands.h"
#include "condition.h"
#include "controller.h"
#include "faults.h"
#include "files.h"
#include "inputs.h"
#include "numerical_control.h"
#include "output_file.h"
#include "plot.h"
#include "progress.h"
#include "realtime.h"
#include "retain.h"
#include "rung/host.h"
#include "rung/retain.h"
#include "schedule.h"
#include "sockets.h"
#include "stopper.h"
#include "trace.h"

namespace rung::host {
namespace {

constexpr int kSuccess = 0, kUsage = 2, kFaulted = 3;
constexpr int64_t kDefaultCycles = 100;
constexpr int64_t kEndAfterStopNs = 1'000'000'000;  // for FB_Exit after a limit
constexpr int64_t kLongRunNs = 3'000'000'000;       // a run that a faster engine would shorten

int refuse(const RunOptions& options, const std::string& what) {
  fflush(options.out);
  fprintf(options.err, "error: %s\n", what.c_str());
  return kUsage;
}

int64_t systemNs() {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * int64_t{1'000'000'000} + now.tv_nsec;
}

std::string durationText(int64_t ns) {
  const std::string ms = millisecondsOf(ns % 1'000'000'000);
  std::string text;
  if (ns >= 1'000'000'000) text = std::to_string(ns / 1'000'000'000) + " s";
  if (ms != "0" || text.empty()) text += (text.empty() ? "" : " ") + ms + " ms";
  return text;
}

struct Run;
Run* running = nullptr;
void endHungRun(const rung_context* context, uint8_t reason);

struct Run {
  Run(const LoadedModule& chosen, const RunOptions& chosen_options)
      : module(chosen),
        options(chosen_options),
        memory(chosen),
        symbols(chosen, memory),
        drivers(chosen, memory),
        tasks(symbols, memory, drivers, chosen_options.interval_ns),
        schedule(tasks, memory.context(), hsio, chosen_options.others_go_on),
        inputs(symbols),
        trace(symbols),
        stop_on(symbols),
        plot(chosen),
        calls(chosen, memory),
        files(chosen_options.files_root, chosen_options.realtime),
        served(chosen),
        channels(chosen_options.serial, served) {
    tasks.serveImage(served);
  }

  ~Run() { running = nullptr; }

  int prepare();
  bool loadAll(std::string& error);
  int start();
  int runVirtual();
  void keepPace(int64_t row);
  int runInRealTime();
  int finish(bool faulted, const std::string& what, const std::string& extra);
  int finishInterrupted(int64_t cycle);

  // Commands. False: the run ends.
  bool obey(int64_t row);
  bool obey(const Command& command);
  bool cycleOnce();
  // Statistics of virtual time say something where activations take time.
  bool hasTimes() const {
    return std::any_of(module.tasks.begin(), module.tasks.end(),
                       [](const rung_task& task) { return task.duration_ns > 0; });
  }
  bool reset(rung_start kind);
  void stop();
  int64_t cycleNs() const { return rows_per_cycle * tasks.rowNs(); }
  int64_t cyclesDone() const { return (rows_done + rows_per_cycle - 1) / rows_per_cycle; }
  int64_t nowNs() { return realtime ? realtime->programNs() : memory.context().now_ns; }
  std::string describe(const rung_context& context, const rung_fault& fault) const {
    return describeFault(context, fault, options.paths);
  }
  void reportStopped();
  void raiseInterrupts(Realtime& threads);
  void reportChanges() const;
  std::string saveRetained() {
    std::string error;
    if (retain && !retain->save(error)) return error;
    return "";
  }

  const LoadedModule& module;
  const RunOptions& options;
  Memory memory;
  Symbols symbols;
  Drivers drivers;
  Tasks tasks;
  Hsio hsio;
  Schedule schedule;
  Inputs inputs;
  Trace trace;
  Condition stop_on;
  Plot plot;
  CallTrace calls;
  Files files;
  Controller controller;
  ServedImage served;
  Channels channels;
  NumericalControl control;
  Commands commands;
  std::optional<Retain> retain;
  std::optional<Stopper> stopper;  // in virtual time
  Realtime* realtime = nullptr;    // while it runs
  rung_host host{};
  char machine_name[256] = {}, machine_address[32] = {};
  std::vector<std::string> reported;  // locations of violated assertions
  std::mutex reported_mutex;          // tasks in real time are threads
  std::vector<bool> is_reported;      // by task: that a fault has stopped it
  int64_t cycles = 0;
  int64_t rows_done = 0;
  int64_t rows_per_cycle = 1;  // the last of them is the cycle's time; cycle 0 has one
  int64_t base_ns = 0;         // the program's time at row 0
  int64_t pace_ns = 0;         // in virtual time: the clock at row 0, while a channel is open
  bool is_stopped = false;     // by a command
  bool single_cycle = false;
  bool has_quit = false;
  bool cannot_pause = false;
  bool is_interrupted = false;  // between two cycles
  std::string cycle_fault;      // of an activation that a command began
};

// Writes retained data off the cycle: a thread of the lowest priority.
class Saver {
 public:
  explicit Saver(Run& run) : run_(run) {
    if (run.retain) thread_ = std::thread([this] { work(); });
  }
  ~Saver() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      done_ = true;
    }
    end_.notify_one();
    thread_.join();
  }
  Saver(const Saver&) = delete;
  Saver& operator=(const Saver&) = delete;

 private:
  void work() {
    std::string last;
    std::unique_lock<std::mutex> lock(mutex_);
    const std::chrono::nanoseconds interval(run_.options.retain_interval_ns);
    while (!end_.wait_for(lock, interval, [this] { return done_; })) {
      const std::string refused = run_.saveRetained();
      if (!refused.empty() && refused != last) fprintf(run_.options.err, "warning: %s\n", refused.c_str());
      last = refused;
    }
  }

  Run& run_;
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool done_ = false;
};

// Code that cannot be stopped: a body in C++, or output to a full pipe. In a signal handler.
void endHungRun(const rung_context* context, uint8_t reason) {
  const std::string what =
      describeCppBody(*context, running->options.paths,
                      reason == RUNG_STOP_TIME ? "fault[time]: the time limit is reached (--timeout)"
                                               : "fault[interrupt]: interrupted");
  fprintf(running->options.err, "%s\n", what.c_str());
  fflush(running->options.err);
  removeUnfinishedFiles();
  _exit(kFaulted);
}

// In virtual time the wall clock starts at 0 with the program.
int64_t unsetClock(Run& run) { return run.options.realtime ? systemNs() : run.memory.context().now_ns; }
int64_t onClock(void* data) {
  Run& run = *static_cast<Run*>(data);
  return run.controller.clock(unsetClock(run));
}
bool onSetClock(void* data, int64_t ns) {
  Run& run = *static_cast<Run*>(data);
  return run.controller.setClock(unsetClock(run), ns);
}
bool onNetwork(void* data, uint32_t port, rung_network* addresses) {
  return static_cast<Run*>(data)->controller.network(port, *addresses);
}
bool onSetNetwork(void* data, uint32_t port, const rung_network* addresses) {
  return static_cast<Run*>(data)->controller.setNetwork(port, *addresses);
}
void onMessage(void* data, uint8_t severity, const char* text) {
  static const char* const words[] = {"note", "warning", "error"};
  const int64_t ms = static_cast<Run*>(data)->nowNs() / 1'000'000;
  fprintf(static_cast<Run*>(data)->options.err, "%lld.%03d s: %s: %s\n", static_cast<long long>(ms / 1000),
          static_cast<int>(ms % 1000), words[severity <= RUNG_MESSAGE_ERROR ? severity : 0], text);
}
void onCall(void* data, const char* pou, const void* instance) { static_cast<Run*>(data)->calls.called(pou, instance); }

// A violated ASSERT outside of tests is reported once per location; the program continues.
void onAssertion(void* data, const rung_assertion* assertion, bool passed, const char* expected, const char* actual) {
  if (passed) return;
  Run& run = *static_cast<Run*>(data);
  const std::string location = shownPath(run.options.paths, assertion->file) + ':' + std::to_string(assertion->line);
  const std::lock_guard<std::mutex> lock(run.reported_mutex);
  if (std::find(run.reported.begin(), run.reported.end(), location) != run.reported.end()) return;
  run.reported.push_back(location);
  std::string message = location + ": assertion failed: expected " + expected + ", got " + actual;
  if (assertion->message != nullptr) message += std::string(" (") + assertion->message + ')';
  fprintf(run.options.err, "%s\n", message.c_str());
}

void Run::reportChanges() const {
  constexpr size_t kMost = 10;  // a changed array of thousands of elements is one mistake
  const std::vector<std::string>& changes = retain->changes();
  for (size_t i = 0; i < changes.size() && i < kMost; ++i)
    fprintf(options.err, "%s: %s\n", options.retain_path.c_str(), changes[i].c_str());
  if (changes.size() > kMost)
    fprintf(options.err, "%s: and %zu more\n", options.retain_path.c_str(), changes.size() - kMost);
}

// All input of the user is checked before anything runs or is written.
bool Run::loadAll(std::string& error) {
  for (const std::string& driver : options.drivers)
    if (!drivers.load(driver, error)) return error.insert(0, "--driver: "), false;
  drivers.simulateModules(symbols, hsio, controller.diagnosis());
  if (!tasks.prepare(error)) return false;
  if (!options.inputs_path.empty() && !inputs.load(options.inputs_path, error)) return false;
  if (!options.control_path.empty() && !commands.open(options.control_path, options.realtime, error)) return false;
  const Trace::Use use =
      options.trace_path.empty() && options.plot_path.empty() ? Trace::Use::LastRow : Trace::Use::Rows;
  if (!trace.choose(options.watch, use, error)) return error.insert(0, "--watch: "), false;
  if (!options.stop_on.empty() && !stop_on.parse(options.stop_on, error)) return error.insert(0, "--stop-on: "), false;
  if (options.retain_path.empty()) return true;
  retain.emplace(symbols, memory, options.retain_path);
  return true;
}

// Initial values, retained data, --set.
int Run::start() {
  rung_context& context = memory.context();
  if (memory.reset() != RUNG_FAULT_NONE) {
    fprintf(options.err, "%s\n", describe(context, context.fault).c_str());
    return kFaulted;
  }
  std::string error;
  if (retain) {
    if (!retain->open(error)) return refuse(options, error);
    retain->restore(options.start >= 0  ? static_cast<rung_start>(options.start)
                    : retain->hasData() ? RUNG_WARM
                                        : RUNG_COLD);
    reportChanges();
    base_ns = context.now_ns;
    schedule.restart(base_ns);
  }
  tasks.readInputs(base_ns);
  for (const auto& [path, value] : options.sets) {
    const std::string what = applySet(symbols, path, value);
    if (!what.empty()) return refuse(options, "--set " + path + "=" + value + ": " + what);
  }
  return kSuccess;
}

int Run::prepare() {
  std::string error;
  if (!loadAll(error)) return refuse(options, error);
  rung_context& context = memory.context();
  host.wall_clock = onClock;
  host.set_wall_clock = onSetClock;
  host.network = onNetwork;
  host.set_network = onSetNetwork;
  host.diagnosis = &controller.diagnosis();
  host.message = onMessage;
  if (gethostname(machine_name, sizeof machine_name - 1) == 0) host.name = machine_name;
  host.address = findOwnAddress(machine_address, sizeof machine_address);
  drivers.serve(host);
  files.serve(host);
  hsio.serve(host);
  channels.serve(host);
  control.serve(module, host, [this](const std::string& text) { onMessage(this, RUNG_MESSAGE_NOTE, text.c_str()); });
  host.assertion = onAssertion;
  context.host = &host;
  context.host_data = this;
  context.step_limit = options.max_steps;
  is_reported.resize(module.tasks.size());
  if (!options.realtime) {
    running = this;
    stopper.emplace(context, endHungRun, Stopper::Interrupt::AfterTheCycle);
    stopper->limitTime(options.timeout_ns);
  }
  const int started = start();
  if (started != kSuccess) return started;
  if (!trace.open(options.trace_path, options.out, error)) return refuse(options, error);
  if (!options.plot_path.empty() && !plot.open(options.plot_path, options.out, trace.variables(), error))
    return refuse(options, error);

  // A cycle of an NCT program is one of its main program: T_PLC.
  if (isNct(module)) {
    for (const Task& task : tasks.all())
      if (std::string_view(tasks.nameOf(task)) == "Main")
        rows_per_cycle = std::max<int64_t>(task.interval_ns / tasks.rowNs(), 1);
  }
  if (options.cycles >= 0)
    cycles = options.cycles;
  else if (options.for_ns >= 0)
    cycles = options.for_ns / cycleNs() + (options.for_ns % cycleNs() != 0 ? 1 : 0);
  else
    cycles = options.realtime ? -1 : inputs.lastCycle() >= 0 ? inputs.lastCycle() + 1 : kDefaultCycles;
  if (options.trace_calls) host.called = onCall;
  return kSuccess;
}

// ---- commands

void Run::stop() {
  is_stopped = true;
  controller.diagnosis().stopped = 1;
  tasks.makeOutputsSafe(nowNs());
}

// TM/TP manual 4.1.4: what a reset keeps. The program is stopped after it.
bool Run::reset(rung_start kind) {
  std::vector<uint64_t> kept(rung_retain_bytes(&module.description) / 8 + 1);
  memory.end();
  rung_retain_pack(&memory.context(), kept.data());
  channels.closeAll();
  const int64_t now = nowNs();
  if (memory.reset(true) != RUNG_FAULT_NONE) {
    cycle_fault = describe(memory.context(), memory.context().fault);
    return false;
  }
  rung_retain_unpack(&memory.context(), kept.data(), kind);
  memory.context().now_ns = now;
  schedule.restart(base_ns + rows_done * tasks.rowNs());
  tasks.restart();
  stop();
  return true;
}

// In virtual time the row that follows is the cycle.
bool Run::cycleOnce() {
  if (!is_stopped) return true;
  tasks.restoreOutputs();
  if (realtime == nullptr) {
    single_cycle = true;
    is_stopped = false;
    return true;
  }
  const bool goes_on = realtime->cycle();
  tasks.makeOutputsSafe(nowNs());
  return goes_on;
}

bool Run::obey(const Command& command) {
  switch (command.kind) {
    case Command::Stop: stop(); break;
    case Command::Start:
      is_stopped = false;
      controller.diagnosis().stopped = 0;
      tasks.restoreOutputs();
      break;
    case Command::Cycle: return cycleOnce();
    case Command::Reset: return reset(command.start);
    case Command::Event:
      if (!(realtime != nullptr ? realtime->raise(command.event) : schedule.raise(command.event)))
        fprintf(options.err, "warning: no task waits for the event `%s`\n", command.event.c_str());
      break;
    case Command::Status:
      fputs(tasks.statistics(0).c_str(), options.err);
      fputs(controller.faults().c_str(), options.err);
      break;
    case Command::Quit: has_quit = true; return false;
  }
  return true;
}

// Does the commands that count before this row. In real time other tasks rest meanwhile, and a flood of commands waits
// for the next turn, so that the watchdog and the program go on.
bool Run::obey(int64_t row) {
  if (options.control_path.empty()) return true;
  constexpr int kMostAtOnce = 16;
  Command command;
  std::string error;
  bool goes_on = true;
  for (int turn = 0; goes_on && (realtime == nullptr || turn < kMostAtOnce) && commands.next(row, command, error);
       ++turn) {
    const bool pauses = realtime != nullptr && command.kind != Command::Event && command.kind != Command::Status;
    if (pauses && !realtime->pause()) {
      cannot_pause = true;
      return false;
    }
    std::unique_lock<std::mutex> rest;
    if (pauses) rest = realtime->rest();
    goes_on = obey(command);
    if (realtime != nullptr && goes_on && !is_stopped) realtime->resume();
    if (single_cycle) return goes_on;
  }
  if (!error.empty()) fprintf(options.err, "warning: %s\n", error.c_str());
  return goes_on;
}

// In real time interrupts are noticed at the starts of rows and when the caller's thread has time.
void Run::raiseInterrupts(Realtime& threads) {
  uint32_t interrupts = 0;
  do {
    hsio.advance(threads.programNs(), interrupts);
    for (uint32_t i = 0; interrupts >> i != 0; ++i)
      if ((interrupts >> i & 1) != 0) threads.raise(rung_hsio_event(i));
  } while (interrupts != 0);
}

void Run::reportStopped() {
  if (!options.others_go_on) return;
  for (const Task& task : tasks.all()) {
    if (!task.stopped || is_reported[task.index]) continue;
    is_reported[task.index] = true;
    rung_context then = memory.context();  // others have run in it since
    then.fault = task.fault;
    then.caller_count = task.caller_count;
    std::copy(task.callers.begin(), task.callers.end(), then.callers);
    std::string text = describe(then, task.fault);
    text.insert(std::min(text.find('\n'), text.size()), "; task `" + tasks.nameOf(task) + "` is stopped");
    fprintf(options.err, "%s\n", text.c_str());
  }
}

// ---- the end

// `what`: why it faulted, a line; `extra`: lines for the user.
int Run::finish(bool faulted, const std::string& what, const std::string& extra) {
  std::string error, reason = what;
  controller.diagnosis().stopped = 1;
  const bool is_listed = options.trace_path.empty() && (!faulted || is_interrupted);
  const std::string last_row = is_listed ? trace.lastRow() : std::string();
  if (memory.end() != RUNG_FAULT_NONE && !faulted) {
    faulted = true;
    reason = describe(memory.context(), memory.context().fault);
  }
  // What FB_Exit leaves is kept; after a fault it is the last complete cycle.
  if (!faulted && retain) retain->copy(base_ns + rows_done * tasks.rowNs());
  tasks.makeOutputsSafe(nowNs());
  const std::string refused = saveRetained();
  if (!trace.close(error) || !plot.close(cycleNs(), error)) return refuse(options, error);
  if (options.trace_path.empty()) {
    fprintf(options.out, "%s%lld cycles of %s, %s of program time\n", last_row.c_str(),
            static_cast<long long>(cyclesDone()), durationText(cycleNs()).c_str(),
            durationText(cyclesDone() * cycleNs()).c_str());
  }
  if (!extra.empty()) fputs(extra.c_str(), options.trace_path == "-" ? options.err : options.out);
  if (fflush(options.out) != 0 || ferror(options.out) != 0)
    return refuse(options, std::string("standard output: ") + strerror(errno));
  if (faulted) {
    fprintf(options.err, "%s\n", reason.c_str());
    return kFaulted;
  }
  if (!refused.empty()) return refuse(options, refused);
  const bool one_stopped = std::any_of(is_reported.begin(), is_reported.end(), [](bool reported) { return reported; });
  return one_stopped ? kFaulted : kSuccess;
}

// ^C: the values are those of the last complete cycle.
int Run::finishInterrupted(int64_t cycle) {
  is_interrupted = true;
  return finish(true, "fault[interrupt]: interrupted after cycle " + std::to_string(cycle), "");
}

std::string watchdogText(const std::string& task) {
  return "fault[watchdog]: task `" + task + "` ran longer than its watchdog allows";
}
std::string driverText(const std::string& driver) { return "fault[driver]: `" + driver + "` does not answer"; }

// ---- virtual time

// A program with open channels keeps pace with the clock: peers do.
void Run::keepPace(int64_t row) {
  if (!channels.isUsed()) {
    pace_ns = 0;
    return;
  }
  const int64_t row_ns = tasks.rowNs();
  if (pace_ns == 0) pace_ns = monotonicNs() - (row - 1) * row_ns;
  channels.runUntil(pace_ns + row * row_ns);
}

int Run::runVirtual() {
  rung_context& context = memory.context();
  const int64_t row_ns = tasks.rowNs();
  int64_t next_save = monotonicNs() + options.retain_interval_ns;
  int64_t next_hint = options.hint_when_long.empty() || isatty(2) == 0 ? INT64_MAX : monotonicNs() + kLongRunNs;
  Progress progress(options.err, cycles);
  const auto ended = [&](const rung_fault& fault, int64_t cycle) {
    progress.clear();
    const bool is_interrupt = fault.kind == RUNG_FAULT_STOP && stopper->reason() == RUNG_STOP_INTERRUPT;
    const std::string in_cycle = is_interrupt ? " in cycle " + std::to_string(cycle) : "";
    std::string what = describe(context, fault);
    what.insert(std::min(what.find('\n'), what.size()), in_cycle);
    stopper->limitTime(fault.kind == RUNG_FAULT_STOP ? kEndAfterStopNs : 0);
    return finish(true, what, "");
  };
  for (int64_t cycle = 0; cycle < cycles; ++cycle) {
    if (!obey(cycle)) break;
    keepPace(rows_done);
    inputs.apply(cycle);
    Schedule::Ending ending = Schedule::Ending::Complete;
    for (int64_t row = rows_done; row <= cycle * rows_per_cycle && ending == Schedule::Ending::Complete; ++row) {
      if (!is_stopped) ending = schedule.run(base_ns + row * row_ns);
    }
    if (options.trace_calls) fputs(calls.line(cycle).c_str(), options.out);
    if (ending == Schedule::Ending::Faulted) return ended(context.fault, cycle);
    if (stopper->reason() == RUNG_STOP_TIME) return ended(stopper->fault(), cycle);
    if (ending == Schedule::Ending::Watchdog)
      return finish(true, watchdogText(tasks.nameOf(*schedule.stoppedTask())), tasks.statistics(0));
    if (const std::string lost = tasks.lostDriver(); !lost.empty()) return finish(true, driverText(lost), "");
    reportStopped();
    trace.row(cycle, cycle * cycleNs());
    plot.row();
    rows_done = cycle * rows_per_cycle + 1;
    if (retain && schedule.isIdle()) retain->copy(base_ns + rows_done * row_ns);
    if (stopper->reason() == RUNG_STOP_INTERRUPT) {
      progress.clear();
      return finishInterrupted(cycle);
    }
    progress.show(cycle);
    if (single_cycle) {
      single_cycle = false;
      stop();
    }
    if (!options.stop_on.empty() && stop_on.holds()) {
      progress.clear();
      return finish(false, "", "stopped after cycle " + std::to_string(cycle) + ": " + options.stop_on + "\n");
    }
    if (next_hint != INT64_MAX && monotonicNs() >= next_hint) {
      progress.clear();
      fprintf(options.err, "%s\n", options.hint_when_long.c_str());
      next_hint = INT64_MAX;
    }
    if (retain && cycle % 64 == 0 && monotonicNs() >= next_save) {
      const std::string refused = saveRetained();
      if (!refused.empty()) return refuse(options, refused);
      next_save = monotonicNs() + options.retain_interval_ns;
    }
  }
  progress.clear();
  stopper->limitTime(0);
  if (!cycle_fault.empty()) return finish(true, cycle_fault, "");
  std::string extra = hasTimes() ? tasks.statistics(rows_done * row_ns) : "";
  if (!options.stop_on.empty() && !has_quit) extra += "never became TRUE: " + options.stop_on + "\n";
  return finish(false, "", extra);
}

// ---- real time

int Run::runInRealTime() {
  const int64_t row_ns = tasks.rowNs();
  if (cycles == 0) return finish(false, "", "");
  RealtimeOptions wanted;
  wanted.rows = cycles < 0 ? cycles : (cycles - 1) * rows_per_cycle + 1;
  wanted.timeout_ns = options.timeout_ns;
  wanted.base_ns = base_ns;
  const bool has_events = std::any_of(module.tasks.begin(), module.tasks.end(),
                                      [](const rung_task& task) { return task.kind == RUNG_EXTERNAL; });
  if (has_events || !options.control_path.empty()) wanted.poll_ns = 10'000'000;
  wanted.others_go_on = options.others_go_on;
  std::atomic<int64_t> row_now{0};
  RealtimeHooks hooks;
  hooks.before = [&](int64_t row) {
    row_now.store(row / rows_per_cycle);
    if ((row + rows_per_cycle - 1) % rows_per_cycle == 0) inputs.apply((row + rows_per_cycle - 1) / rows_per_cycle);
  };
  hooks.after = [&](int64_t row) {
    if (row % rows_per_cycle != 0) return;
    trace.row(row / rows_per_cycle, row * row_ns);
    plot.row();
  };
  if (retain) hooks.complete = [&](int64_t now_ns) { retain->copy(now_ns); };
  RealtimeResult result;
  Realtime threads(tasks, memory.context(), wanted, hooks);
  hooks.idle = [&] {
    reportStopped();
    raiseInterrupts(threads);
    if (!obey(row_now.load())) threads.end();
  };
  {
    const Saver saver(*this);
    realtime = &threads;
    channels.start();
    files.work().start();  // not in the first cycle that needs it
    result = threads.run();
    channels.stop();
  }
  rows_done = result.rows;
  if (const std::string simulated = drivers.simulatedNames(); !simulated.empty())
    fprintf(options.err, "note: these modules were simulated: %s\n", simulated.c_str());
  if (!result.missing.empty()) fprintf(options.err, "note: %s\n", result.missing.c_str());
  std::string what = cycle_fault;
  bool faulted = !cycle_fault.empty();
  switch (result.kind) {
    case RealtimeResult::Complete:
    case RealtimeResult::Signal: break;
    case RealtimeResult::Faulted:
      faulted = true;
      what = describe(result.context != nullptr ? *result.context : memory.context(), result.fault);
      break;
    case RealtimeResult::Watchdog:
      faulted = true;
      what = watchdogText(result.name);
      break;
    case RealtimeResult::Driver:
      faulted = true;
      what = driverText(result.name);
      break;
  }
  if (result.hung || cannot_pause) {
    // A thread may still be inside the program, so nothing of it runs any more.
    tasks.makeOutputsSafe(nowNs());
    saveRetained();
    std::string error;
    trace.close(error);
    plot.close(row_ns, error);
    fflush(options.out);
    if (what.empty()) what = describe(memory.context(), {RUNG_FAULT_STOP, RUNG_NONE, RUNG_STOP_INTERRUPT});
    fprintf(options.err, "%s\n", what.c_str());
    fflush(options.err);
    _exit(kFaulted);
  }
  reportStopped();
  const int status = finish(faulted, what, tasks.statistics(result.elapsed_ns));
  realtime = nullptr;
  return status;
}

}  // namespace

int run(const rung_module& description, const RunOptions& options) {
  if (const char* const why = refusal(description)) return refuse(options, why);
  const LoadedModule module(description);
  const bool has_program = std::any_of(module.symbols.begin(), module.symbols.end(),
                                       [](const rung_symbol& symbol) { return symbol.is_program != 0; });
  if (!has_program) return refuse(options, "there is no PROGRAM to run; add one that calls what you want to see");
  Run run(module, options);
  const int prepared = run.prepare();
  if (prepared != kSuccess) return prepared;
  return options.realtime ? run.runInRealTime() : run.runVirtual();
}

}  // namespace rung::host
