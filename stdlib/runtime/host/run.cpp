// SPDX-License-Identifier: Apache-2.0
// `rung run` and executables of `rung build`: runs a module in virtual or real time. See rung/host.h.
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "call_trace.h"
#include "changes.h"
#include "clock.h"
#include "commands.h"
#include "condition.h"
#include "faults.h"
#include "inputs.h"
#include "monitor.h"
#include "output_file.h"
#include "plot.h"
#include "progress.h"
#include "retain.h"
#include "rung/host.h"
#include "session.h"
#include "stopper.h"
#include "trace.h"

namespace rung::host {
namespace {

constexpr const char* kHasFaulted = "the program has faulted; `reset` makes it ready to start again";
constexpr int kSuccess = 0, kUsage = 2, kFaulted = 3;
constexpr int64_t kDefaultCycles = 100;
constexpr int64_t kEndAfterStopNs = 1'000'000'000;  // for FB_Exit after a limit
constexpr int64_t kLongRunNs = 3'000'000'000;       // a run that a faster engine would shorten

int refuse(const RunOptions& options, const std::string& what) {
  fflush(options.out);
  fprintf(options.err, "error: %s\n", what.c_str());
  return kUsage;
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
  Run(const rung_module& module, const RunOptions& chosen_options)
      : options(chosen_options),
        session(module, SessionOptions::of(chosen_options), hooks()),
        inputs(session.symbols()),
        trace(session.symbols()),
        plot(session.module()),
        changes(session, chosen_options, [this] { return holdMonitor(); }) {}

  ~Run() { running = nullptr; }

  int prepare();
  bool loadAll(std::string& error);
  int start();
  int64_t cyclesWanted() const;
  int runVirtual();
  std::optional<int> runCycle(int64_t cycle);
  std::optional<int> attend(int64_t cycle);
  int runInRealTime();
  int finish(bool faulted, const std::string& what, const std::string& extra);
  int finishEnded(const Ending& ending, int64_t cycle);
  int finishInterrupted(int64_t cycle);
  [[noreturn]] void leaveHung(std::string what);
  RealtimeOptions realtimeOptions() const;
  RealtimeHooks realtimeHooks();

  SessionHooks hooks();
  void printMessage(uint8_t severity, const char* text);
  void reportAssertion(const rung_assertion& assertion, const char* expected, const char* actual);
  // The commands that count before this row, and what clients of the monitor ask. False: the run ends.
  bool obey(int64_t row);
  void print(const Command& command);
  Answer obey(const Command& command);
  bool openMonitor(std::string& error);
  bool waitForReset(const Ending& ending, int64_t cycle);
  void keepPace(int64_t cycle);
  std::optional<Changes::Outcome> change(const Command& command);
  void report(const std::optional<Changes::Outcome>& change, const std::string& location);
  void followChange();
  void warnMissing(const char* option, const std::vector<std::string>& paths) const;
  bool goBack(const Ending& ending);
  // Clients of the monitor do not see the program while one holds this.
  std::unique_lock<std::mutex> holdMonitor() { return monitor ? monitor->hold() : std::unique_lock<std::mutex>(); }
  const ShownPaths& paths() const { return changes.paths().empty() ? options.paths : changes.paths(); }
  // Statistics of virtual time say something where activations take time.
  bool hasTimes() const {
    const auto& tasks = session.module().tasks;
    return std::any_of(tasks.begin(), tasks.end(), [](const rung_task& task) { return task.duration_ns > 0; });
  }
  std::string describe(const rung_context& context, const rung_fault& fault) const {
    return describeFault(context, fault, paths());
  }
  std::string describe(const Ending& ending) { return describeEnding(ending, session.context(), paths()); }
  void reportStopped();
  void reportChanges() const;
  std::string saveRetained() {
    std::string error;
    if (retain && !retain->save(error)) return error;
    return "";
  }

  const RunOptions& options;
  Session session;
  Inputs inputs;
  Trace trace;
  std::optional<Condition> stop_on;  // none: the run has no condition to stop on
  Plot plot;
  std::optional<CallTrace> calls;
  Commands commands;
  Changes changes;
  std::optional<Retain> retain;
  std::optional<Monitor> monitor;
  std::optional<Stopper> stopper;     // in virtual time
  std::optional<Progress> progress;   // in virtual time
  std::vector<std::string> reported;  // locations of violated assertions
  std::mutex reported_mutex;          // tasks in real time are threads
  std::vector<bool> is_reported;      // by task: that a fault has stopped it
  int64_t cycles = 0;
  int64_t next_save_ns = 0, next_hint_ns = INT64_MAX;  // in virtual time
  int64_t pace_ns = 0;                                 // in virtual time with a monitor: the clock at cycle 0
  int64_t first_row = 0;                               // in real time: of the threads that run
  std::atomic<int64_t> cycle_now{0};
  bool ends = false;              // a command says so
  bool is_faulted = false;        // and waits for a reset
  bool is_fault_printed = false;  // before the end of the run
  bool has_quit = false;
  bool has_refused = false;  // a command
  bool cannot_pause = false;
  bool is_interrupted = false;  // between two cycles
  Ending command_ending;        // of an activation that a command began
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
      describeCppBody(*context, running->paths(),
                      reason == RUNG_STOP_TIME ? "fault[time]: the time limit is reached (--timeout)"
                                               : "fault[interrupt]: interrupted");
  fprintf(running->options.err, "%s\n", what.c_str());
  fflush(running->options.err);
  removeUnfinishedFiles();
  _exit(kFaulted);
}

SessionHooks Run::hooks() {
  SessionHooks hooks;
  hooks.message = [this](uint8_t severity, const char* text) { printMessage(severity, text); };
  hooks.assertion = [this](const rung_assertion& assertion, bool passed, const char* expected, const char* actual) {
    if (!passed) reportAssertion(assertion, expected, actual);
  };
  hooks.changed = [this] { followChange(); };
  if (options.trace_calls)
    hooks.called = [this](const char* pou, const void* instance) { calls->called(pou, instance); };
  return hooks;
}

void Run::printMessage(uint8_t severity, const char* text) {
  const int64_t now_ns = session.nowNs();
  fprintf(options.err, "%s\n", messageLine(now_ns, severity, text).c_str());
  if (monitor) monitor->log().addMessage(now_ns, severityWord(severity), text);
}

// A violated ASSERT outside of tests is reported once per location; the program continues.
void Run::reportAssertion(const rung_assertion& assertion, const char* expected, const char* actual) {
  const std::string location = shownPath(paths(), assertion.file) + ':' + std::to_string(assertion.line);
  const std::lock_guard<std::mutex> lock(reported_mutex);
  if (std::find(reported.begin(), reported.end(), location) != reported.end()) return;
  reported.push_back(location);
  const std::string message = location + ": " + describeAssertion(assertion, expected, actual);
  fprintf(options.err, "%s\n", message.c_str());
  if (monitor) monitor->log().addMessage(session.nowNs(), "error", message);
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
  if (!session.load(error)) return false;
  if (!options.inputs_path.empty() && !inputs.load(options.inputs_path, error)) return false;
  if (!options.control_path.empty() && !commands.open(options.control_path, options.realtime, error)) return false;
  const Trace::Use use =
      options.trace_path.empty() && options.plot_path.empty() ? Trace::Use::LastRow : Trace::Use::Rows;
  if (!trace.choose(options.watch, use, error)) return error.insert(0, "--watch: "), false;
  if (!options.stop_on.empty() && !stop_on.emplace(session.symbols()).parse(options.stop_on, error))
    return error.insert(0, "--stop-on: "), false;
  calls.emplace(session.memory());
  if (!options.retain_path.empty()) retain.emplace(session.symbols(), session.memory(), options.retain_path);
  return true;
}

bool Run::openMonitor(std::string& error) {
  if (options.monitor.address.empty()) return true;
  monitor.emplace(
      session, options, [this](const Command& command) { return obey(command); },
      [this](const Command& command) { return change(command); },
      [this]() -> const std::vector<rung_pou_view>& { return changes.pous(); });
  if (!monitor->start(error)) return false;
  fprintf(options.err, "monitor: %s\n", monitor->url().c_str());
  fflush(options.err);
  if (options.monitor.on_start) options.monitor.on_start(monitor->url());
  return true;
}

// Initial values, retained data, --set.
int Run::start() {
  if (const Ending ending = session.init(); !ending.isComplete()) {
    fprintf(options.err, "%s\n", describe(ending).c_str());
    return kFaulted;
  }
  std::string error;
  if (retain) {
    if (!retain->open(error)) return refuse(options, error);
    retain->restore(options.start >= 0  ? static_cast<rung_start>(options.start)
                    : retain->hasData() ? RUNG_WARM
                                        : RUNG_COLD);
    reportChanges();
  }
  session.begin();
  for (const auto& [path, value] : options.sets) {
    const std::string what = applySet(session.symbols(), path, value);
    if (!what.empty()) return refuse(options, "--set " + path + "=" + value + ": " + what);
  }
  return kSuccess;
}

// -1: until something else ends the run.
int64_t Run::cyclesWanted() const {
  const int64_t cycle_ns = session.cycleNs();
  if (options.cycles >= 0) return options.cycles;
  if (options.for_ns >= 0) return options.for_ns / cycle_ns + (options.for_ns % cycle_ns != 0 ? 1 : 0);
  if (options.realtime || monitor) return -1;
  return inputs.lastCycle() >= 0 ? inputs.lastCycle() + 1 : kDefaultCycles;
}

int Run::prepare() {
  std::string error;
  if (!loadAll(error)) return refuse(options, error);
  is_reported.resize(session.module().tasks.size());
  running = this;
  if (!options.realtime) {
    stopper.emplace(session.context(), endHungRun, Stopper::Interrupt::AfterTheCycle);
    if (!options.monitor.address.empty()) stopper->alsoOnTermination();
    stopper->limitTime(options.timeout_ns);
  }
  const int started = start();
  if (started != kSuccess) return started;
  if (!openMonitor(error)) return refuse(options, error);
  if (options.trace_forces) trace.markForced(session.forces());
  if (!trace.open(options.trace_path, options.out, error)) return refuse(options, error);
  if (!options.plot_path.empty() && !plot.open(options.plot_path, options.out, trace.variables(), error))
    return refuse(options, error);
  cycles = cyclesWanted();
  return kSuccess;
}

// After a fault only a reset makes sense of what changes how the program runs.
Answer Run::obey(const Command& command) {
  Answer answer;
  const bool is_about_running = command.kind <= Command::Event && command.kind != Command::Reset;
  if (is_faulted && is_about_running) {
    answer.error = kHasFaulted;
    answer.is_busy = true;
    return answer;
  }
  answer = session.obey(command);
  cannot_pause = answer.hangs;
  has_quit = has_quit || command.kind == Command::Quit;
  if (command.kind == Command::Reset && answer.goes_on) is_faulted = false;
  if (!answer.goes_on) command_ending = answer.ending;
  ends = ends || !answer.goes_on;
  return answer;
}

// In real time a flood of commands waits for the next turn, so that the watchdog and the program go on.
bool Run::obey(int64_t row) {
  if (!is_faulted) report(changes.attend(), "");
  constexpr int kMostAtOnce = 16;
  Command command;
  std::string error;
  for (int turn = 0; !ends && (!options.realtime || turn < kMostAtOnce) && commands.next(row, command, error); ++turn) {
    print(command);
    if (session.isSingleCycle()) return !ends;
  }
  if (!error.empty()) fprintf(options.err, "warning: %s\n", error.c_str());
  if (monitor) monitor->attend();
  return !ends;
}

// Of --control.
void Run::print(const Command& command) {
  if (command.kind == Command::Change) return report(change(command), command.location);
  const Answer answer = obey(command);
  fputs(answer.text.c_str(), options.err);
  fputs(answer.values.c_str(), options.trace_path == "-" ? options.err : options.out);
  if (!answer.error.empty()) fprintf(options.err, "error: %s: %s\n", command.location.c_str(), answer.error.c_str());
  has_refused = has_refused || !answer.error.empty();
  if (!answer.warning.empty()) fprintf(options.err, "warning: %s\n", answer.warning.c_str());
}

// ---- online changes

// Empty: it is made when it is ready.
std::optional<Changes::Outcome> Run::change(const Command& command) {
  if (is_faulted) return Changes::refused(kHasFaulted);
  return changes.begin(command);
}

// `location`: of the command, empty for files that changed.
void Run::report(const std::optional<Changes::Outcome>& change, const std::string& location) {
  if (!change || (monitor && monitor->answerChange(*change))) return;
  const std::string& error = change->report.error;
  if (!error.empty())
    fprintf(options.err, "error: %s%s\n", location.empty() ? "" : (location + ": ").c_str(), error.c_str());
  has_refused = has_refused || !error.empty();
  fputs(change->report.text().c_str(), options.err);
}

void Run::warnMissing(const char* option, const std::vector<std::string>& missing) const {
  for (const std::string& path : missing)
    fprintf(options.err, "warning: %s: the program does not have `%s` any more\n", option, path.c_str());
}

// Another version has taken over: what refers to the one before goes on with this one.
void Run::followChange() {
  if (stopper) Stopper::moveTo(session.context());
  warnMissing("--inputs", inputs.moveTo(session.symbols()));
  warnMissing(options.watch.empty() ? "--trace" : "--watch", trace.moveTo(session.symbols()));
  if (options.trace_forces) trace.markForced(session.forces());
  plot.moveTo(session.symbols());
  calls.emplace(session.memory());
  std::string error;
  if (stop_on && !stop_on.emplace(session.symbols()).parse(options.stop_on, error)) {
    fprintf(options.err, "warning: --stop-on: %s\n", error.c_str());
    stop_on.reset();
  }
  if (retain && !retain->moveTo(session.symbols(), session.memory(), error))
    fprintf(options.err, "warning: %s\n", error.c_str());
  is_reported.assign(session.module().tasks.size(), false);
  if (monitor) monitor->followChange();
}

// A version that took over a few cycles ago has faulted.
bool Run::goBack(const Ending& ending) {
  if (ending.kind != Ending::Faulted || ending.fault.kind == RUNG_FAULT_STOP) return false;
  const std::string what = describe(ending);
  const std::unique_lock<std::mutex> held = holdMonitor();
  if (!changes.goBack()) return false;
  fprintf(options.err, "%s\nnote: the version before goes on, with its values of before the change\n", what.c_str());
  if (monitor) monitor->noteRollback(what);
  return true;
}

void Run::reportStopped() {
  if (!options.others_go_on) return;
  for (const Task& task : session.tasks().all()) {
    if (!task.stopped || is_reported[task.index]) continue;
    is_reported[task.index] = true;
    rung_context then = session.context();  // others have run in it since
    then.fault = task.fault;
    then.caller_count = task.caller_count;
    std::copy(task.callers.begin(), task.callers.end(), then.callers);
    std::string text = describe(then, task.fault);
    text.insert(std::min(text.find('\n'), text.size()), "; task `" + session.tasks().nameOf(task) + "` is stopped");
    fprintf(options.err, "%s\n", text.c_str());
    if (monitor) monitor->log().addFault(session.nowNs(), session.cyclesDone(), text);
  }
}

// ---- a run with a monitor

// Keeps pace with the clock. What a long cycle has lost is not made up for.
void Run::keepPace(int64_t cycle) {
  constexpr int64_t kMostBehindNs = 100'000'000;
  if (!monitor) return;
  const int64_t now = monotonicNs(), since_begin = (cycle + 1) * session.cycleNs();
  if (pace_ns == 0 || now - pace_ns - since_begin > kMostBehindNs) pace_ns = now - since_begin + session.cycleNs();
  while (!ends && stopper->reason() == RUNG_STOP_NONE && monotonicNs() < pace_ns + since_begin)
    monitor->attendUntil(pace_ns + since_begin);
}

// After a fault it rests with safe outputs until a client resets it. False: the run ends.
bool Run::waitForReset(const Ending& ending, int64_t cycle) {
  if (!monitor || has_quit || (stopper && stopper->reason() != RUNG_STOP_NONE)) return false;
  const std::string what = describe(ending);
  fprintf(options.err, "%s\n", what.c_str());
  monitor->log().addFault(session.nowNs(), cycle, what);
  session.markStopped();
  session.makeOutputsSafe();
  monitor->setState(Monitor::State::Faulted);
  std::optional<Stopper> own;  // in real time the threads of the tasks have had the signals
  if (!stopper) own.emplace(session.context(), endHungRun).alsoOnTermination();
  const Stopper& signals = stopper ? *stopper : *own;
  is_faulted = true;
  do {
    ends = false;
    command_ending = {};
    monitor->attendUntil(monotonicNs() + session.cycleNs());
    obey(cycle);
  } while (is_faulted && !has_quit && signals.reason() == RUNG_STOP_NONE);
  is_fault_printed = is_faulted;
  monitor->setState(Monitor::State::Stopped);
  return !is_faulted;
}

// ---- the end

// `what`: why it faulted, a line; `extra`: lines for the user.
int Run::finish(bool faulted, const std::string& what, const std::string& extra) {
  std::string error, reason = what;
  if (monitor) monitor->stop();
  session.markStopped();
  const bool is_listed = options.trace_path.empty() && (!faulted || is_interrupted);
  const std::string last_row = is_listed ? trace.lastRow() : std::string();
  if (const Ending ending = session.end(); !ending.isComplete() && !faulted) {
    faulted = true;
    reason = describe(ending);
  }
  // What FB_Exit leaves is kept; after a fault it is the last complete cycle.
  if (!faulted && retain) retain->copy(session.nextRowNs());
  session.makeOutputsSafe();
  const std::string refused = saveRetained();
  if (!trace.close(error) || !plot.close(session.cycleNs(), error)) return refuse(options, error);
  if (options.trace_path.empty()) {
    fprintf(options.out, "%s%lld cycles of %s, %s of program time\n", last_row.c_str(),
            static_cast<long long>(session.cyclesDone()), durationText(session.cycleNs()).c_str(),
            durationText(session.cyclesDone() * session.cycleNs()).c_str());
  }
  if (!extra.empty()) fputs(extra.c_str(), options.trace_path == "-" ? options.err : options.out);
  if (fflush(options.out) != 0 || ferror(options.out) != 0)
    return refuse(options, std::string("standard output: ") + strerror(errno));
  if (faulted) {
    if (!is_fault_printed) fprintf(options.err, "%s\n", reason.c_str());
    return kFaulted;
  }
  if (!refused.empty()) return refuse(options, refused);
  const bool one_stopped = std::any_of(is_reported.begin(), is_reported.end(), [](bool reported) { return reported; });
  return one_stopped ? kFaulted : has_refused ? kUsage : kSuccess;
}

// ^C: the values are those of the last complete cycle.
int Run::finishInterrupted(int64_t cycle) {
  is_interrupted = true;
  return finish(true, "fault[interrupt]: interrupted after cycle " + std::to_string(cycle), "");
}

// ---- virtual time

int Run::finishEnded(const Ending& ending, int64_t cycle) {
  if (ending.kind == Ending::Watchdog) return finish(true, describe(ending), session.tasks().statistics(0));
  if (ending.kind == Ending::Driver) return finish(true, describe(ending), "");
  progress->clear();
  const bool is_stop = ending.fault.kind == RUNG_FAULT_STOP;
  std::string what = describe(ending);
  if (is_stop && stopper->reason() == RUNG_STOP_INTERRUPT)
    what.insert(std::min(what.find('\n'), what.size()), " in cycle " + std::to_string(cycle));
  stopper->limitTime(is_stop ? kEndAfterStopNs : 0);
  return finish(true, what, "");
}

// The exit code when the run ends with this cycle.
std::optional<int> Run::runCycle(int64_t cycle) {
  Ending ending = session.cycle();
  if (options.trace_calls) fputs(calls->line(cycle).c_str(), options.out);
  if (ending.kind != Ending::Faulted && stopper->reason() == RUNG_STOP_TIME)
    ending = {Ending::Faulted, stopper->fault(), nullptr, ""};
  const bool went_back = !ending.isComplete() && goBack(ending);
  while (!ending.isComplete() && !went_back) {
    if (!waitForReset(ending, cycle)) return finishEnded(ending, cycle);
    ending = session.cycle();
  }
  reportStopped();
  const int64_t time_ns = session.rowTimeNs(cycle * session.rowsPerCycle());
  trace.row(cycle, time_ns);
  plot.row();
  if (!went_back) session.completeCycle();
  if (monitor) monitor->completeCycle(cycle, time_ns);
  if (retain && session.isIdle()) retain->copy(session.nextRowNs());
  if (stopper->reason() == RUNG_STOP_INTERRUPT) {
    progress->clear();
    return monitor ? finish(false, "", "") : finishInterrupted(cycle);
  }
  if (!monitor) progress->show(cycle);
  session.stopAfterSingleCycle();
  if (!stop_on || !stop_on->holds()) return std::nullopt;
  progress->clear();
  return finish(false, "", "stopped after cycle " + std::to_string(cycle) + ": " + options.stop_on + "\n");
}

// What the run does now and then, by the clock. The exit code when retained data cannot be written.
std::optional<int> Run::attend(int64_t cycle) {
  if (next_hint_ns != INT64_MAX && monotonicNs() >= next_hint_ns) {
    progress->clear();
    fprintf(options.err, "%s\n", options.hint_when_long.c_str());
    next_hint_ns = INT64_MAX;
  }
  if (!retain || cycle % 64 != 0 || monotonicNs() < next_save_ns) return std::nullopt;
  const std::string refused = saveRetained();
  if (!refused.empty()) return refuse(options, refused);
  next_save_ns = monotonicNs() + options.retain_interval_ns;
  return std::nullopt;
}

int Run::runVirtual() {
  next_save_ns = monotonicNs() + options.retain_interval_ns;
  if (!options.hint_when_long.empty() && !monitor && isatty(2) != 0) next_hint_ns = monotonicNs() + kLongRunNs;
  progress.emplace(options.err, cycles);
  for (int64_t cycle = 0; cycles < 0 || cycle < cycles; ++cycle) {
    if (!obey(cycle) && (command_ending.isComplete() || !waitForReset(command_ending, cycle))) break;
    inputs.apply(cycle);
    if (const std::optional<int> code = runCycle(cycle)) return *code;
    if (const std::optional<int> code = attend(cycle)) return *code;
    keepPace(cycle);
  }
  progress->clear();
  stopper->limitTime(0);
  if (!command_ending.isComplete()) return finish(true, describe(command_ending), "");
  std::string extra = hasTimes() ? session.tasks().statistics(session.nextRowNs() - session.beginNs()) : "";
  if (!options.stop_on.empty() && !has_quit) extra += "never became TRUE: " + options.stop_on + "\n";
  return finish(false, "", extra);
}

// ---- real time

// A thread may still be inside the program, so nothing of it runs any more.
void Run::leaveHung(std::string what) {
  session.makeOutputsSafe();
  saveRetained();
  std::string error;
  trace.close(error);
  plot.close(session.tasks().rowNs(), error);
  fflush(options.out);
  if (what.empty()) what = describe(session.context(), {RUNG_FAULT_STOP, RUNG_NONE, RUNG_STOP_INTERRUPT});
  fprintf(options.err, "%s\n", what.c_str());
  fflush(options.err);
  _exit(kFaulted);
}

RealtimeOptions Run::realtimeOptions() const {
  RealtimeOptions wanted;
  wanted.rows = cycles < 0 ? cycles : std::max<int64_t>((cycles - 1) * session.rowsPerCycle() + 1 - first_row, 1);
  wanted.timeout_ns = options.timeout_ns;
  wanted.base_ns = session.nowNs();
  const auto& tasks = session.module().tasks;
  const bool has_events =
      std::any_of(tasks.begin(), tasks.end(), [](const rung_task& task) { return task.kind == RUNG_EXTERNAL; });
  if (has_events || monitor || options.change.has_changed || !options.control_path.empty()) wanted.poll_ns = 10'000'000;
  wanted.others_go_on = options.others_go_on;
  return wanted;
}

RealtimeHooks Run::realtimeHooks() {
  RealtimeHooks hooks;
  hooks.before = [this](int64_t row) {
    const int64_t per_cycle = session.rowsPerCycle();
    row += first_row;
    cycle_now.store(row / per_cycle);
    if ((row + per_cycle - 1) % per_cycle == 0) inputs.apply((row + per_cycle - 1) / per_cycle);
  };
  hooks.after = [this](int64_t row) {
    row += first_row;
    if (row % session.rowsPerCycle() != 0) return;
    const int64_t cycle = row / session.rowsPerCycle(), time_ns = session.rowTimeNs(row);
    trace.row(cycle, time_ns);
    plot.row();
    if (monitor) monitor->completeCycle(cycle, time_ns);
  };
  hooks.go_back = [this](const Ending& ending) { return goBack(ending); };
  if (retain) hooks.complete = [this](int64_t now_ns) { retain->copy(now_ns); };
  hooks.idle = [this] {
    reportStopped();
    session.raiseInterrupts();
    if (!obey(cycle_now.load())) session.endThreads();
  };
  return hooks;
}

int Run::runInRealTime() {
  if (cycles == 0) return finish(false, "", "");
  const RealtimeHooks hooks = realtimeHooks();
  RealtimeResult result;
  Ending ending;
  bool is_too_long = false;
  do {
    const Saver saver(*this);
    result = session.runInRealTime(realtimeOptions(), hooks);
    first_row += result.rows;
    ending = result.ending.isComplete() ? command_ending : result.ending;
    is_too_long = ending.fault.kind == RUNG_FAULT_STOP;
  } while (!ending.isComplete() && !is_too_long && !result.hung && !cannot_pause &&
           waitForReset(ending, cycle_now.load()));
  if (const std::string simulated = session.drivers().simulatedNames(); !simulated.empty())
    fprintf(options.err, "note: these modules were simulated: %s\n", simulated.c_str());
  if (!result.missing.empty()) fprintf(options.err, "note: %s\n", result.missing.c_str());
  if (result.hung || cannot_pause) leaveHung(describe(ending));
  reportStopped();
  return finish(!ending.isComplete(), describe(ending), session.tasks().statistics(result.elapsed_ns));
}

}  // namespace

int run(const rung_module& module, const RunOptions& options) {
  if (const char* const why = refusal(module)) return refuse(options, why);
  bool has_program = false;
  for (uint32_t i = 0; i < module.symbols.count; ++i) has_program |= rung_symbol_at(&module, i)->is_program != 0;
  if (!has_program) return refuse(options, "there is no PROGRAM to run; add one that calls what you want to see");
  Run run(module, options);
  const int prepared = run.prepare();
  if (prepared != kSuccess) return prepared;
  return options.realtime ? run.runInRealTime() : run.runVirtual();
}

}  // namespace rung::host
