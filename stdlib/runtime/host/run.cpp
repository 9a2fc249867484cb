// `rung run` and executables of `rung build`: runs a module in virtual or real time. See rung/host.h.
#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "call_trace.h"
#include "condition.h"
#include "faults.h"
#include "files.h"
#include "inputs.h"
#include "output_file.h"
#include "plot.h"
#include "realtime.h"
#include "retain.h"
#include "rung/host.h"
#include "schedule.h"
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

int64_t systemClock(void*) {
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

int64_t processorNs() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * int64_t{1'000'000'000} + now.tv_nsec;
}

struct Run;
Run* running = nullptr;
void endHungRun(const rung_context* context, uint8_t reason);

struct Run {
  Run(const rung_module& chosen, const RunOptions& chosen_options)
      : module(chosen),
        options(chosen_options),
        memory(chosen),
        symbols(chosen, memory),
        schedule(symbols, chosen_options.interval_ns),
        inputs(symbols),
        trace(symbols),
        stop_on(symbols),
        plot(chosen),
        calls(chosen, memory),
        files(chosen_options.files_root) {}

  ~Run() { running = nullptr; }

  int prepare();
  int runVirtual();
  int runInRealTime();
  int finish(bool faulted, rung_fault fault, const std::string& extra);
  // A changed array of thousands of elements is one mistake.
  void reportChanges(const Retain& restored) const {
    constexpr size_t kMost = 10;
    const std::vector<std::string>& changes = restored.changes();
    for (size_t i = 0; i < changes.size() && i < kMost; ++i)
      fprintf(options.err, "%s: %s\n", options.retain_path.c_str(), changes[i].c_str());
    if (changes.size() > kMost)
      fprintf(options.err, "%s: and %zu more\n", options.retain_path.c_str(), changes.size() - kMost);
  }
  std::string saveRetained() {
    std::string error;
    if (retain && !retain->save(symbols, error)) return error;
    return "";
  }

  const rung_module& module;
  const RunOptions& options;
  Memory memory;
  Symbols symbols;
  Schedule schedule;
  Inputs inputs;
  Trace trace;
  Condition stop_on;
  Plot plot;
  CallTrace calls;
  Files files;
  std::optional<Retain> retain;
  std::optional<Stopper> stopper;  // in virtual time
  rung_host host{};
  char machine_name[256] = {};
  std::vector<std::string> reported;  // locations of violated assertions
  std::mutex reported_mutex;          // tasks in real time are threads
  int64_t cycles = 0;
  int64_t rows_done = 0;
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
int64_t virtualClock(void* data) { return static_cast<Run*>(data)->memory.context().now_ns; }
void onMessage(void* data, uint8_t severity, const char* text) {
  static const char* const words[] = {"note", "warning", "error"};
  const int64_t ms = static_cast<Run*>(data)->memory.context().now_ns / 1'000'000;
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

int Run::prepare() {
  std::string error;
  if (!schedule.prepare(error)) return refuse(options, error);
  // All input of the user is checked before anything runs or is written.
  if (!options.inputs_path.empty() && !inputs.load(options.inputs_path, error)) return refuse(options, error);
  if (!trace.choose(options.watch, error)) return refuse(options, "--watch: " + error);
  if (!options.stop_on.empty() && !stop_on.parse(options.stop_on, error)) return refuse(options, "--stop-on: " + error);

  rung_context& context = memory.context();
  host.wall_clock = options.realtime ? systemClock : virtualClock;
  host.message = onMessage;
  if (gethostname(machine_name, sizeof machine_name - 1) == 0) host.name = machine_name;
  files.serve(host);
  host.assertion = onAssertion;
  context.host = &host;
  context.host_data = this;
  context.step_limit = options.max_steps;
  if (!options.realtime) {
    running = this;
    stopper.emplace(context, endHungRun);
    stopper->limitTime(options.timeout_ns);
  }
  if (memory.reset() != RUNG_FAULT_NONE) {
    fprintf(options.err, "%s\n", describeFault(context, context.fault, options.paths).c_str());
    return kFaulted;
  }
  if (!options.retain_path.empty()) {
    retain.emplace(module, memory, options.retain_path);
    const rung_start start = options.start >= 0 ? static_cast<rung_start>(options.start)
                             : retain->exists() ? RUNG_WARM
                                                : RUNG_COLD;
    if (!retain->restore(start, symbols, error)) return refuse(options, error);
    reportChanges(*retain);
  }
  for (const auto& [path, value] : options.sets) {
    const std::string what = applySet(symbols, path, value);
    if (!what.empty()) return refuse(options, "--set " + path + "=" + value + ": " + what);
  }
  if (!trace.open(options.trace_path, options.out, error)) return refuse(options, error);
  if (!options.plot_path.empty() && !plot.open(options.plot_path, options.out, trace.variables(), error))
    return refuse(options, error);

  const int64_t row_ns = schedule.rowNs();
  if (options.cycles >= 0)
    cycles = options.cycles;
  else if (options.for_ns >= 0)
    cycles = options.for_ns / row_ns + (options.for_ns % row_ns != 0 ? 1 : 0);
  else
    cycles = options.realtime ? -1 : inputs.lastCycle() >= 0 ? inputs.lastCycle() + 1 : kDefaultCycles;
  if (options.trace_calls) host.called = onCall;
  return kSuccess;
}

int Run::finish(bool faulted, rung_fault fault, const std::string& extra) {
  std::string error;
  if (stopper) stopper->limitTime(fault.kind == RUNG_FAULT_STOP ? kEndAfterStopNs : 0);
  const std::string last_row = options.trace_path.empty() && !faulted ? trace.lastRow() : std::string();
  if (memory.end() != RUNG_FAULT_NONE && !faulted) {
    faulted = true;
    fault = memory.context().fault;
  }
  if (faulted) memory.makeOutputsSafe();
  const std::string refused = saveRetained();
  if (!trace.close(error) || !plot.close(schedule.rowNs(), error)) return refuse(options, error);
  if (options.trace_path.empty()) {
    fprintf(options.out, "%s%lld cycles of %s, %s of program time\n", faulted ? "" : last_row.c_str(),
            static_cast<long long>(rows_done), durationText(schedule.rowNs()).c_str(),
            durationText(rows_done * schedule.rowNs()).c_str());
  }
  if (!extra.empty()) fputs(extra.c_str(), options.trace_path == "-" ? options.err : options.out);
  fflush(options.out);
  if (faulted) {
    fprintf(options.err, "%s\n", describeFault(memory.context(), fault, options.paths).c_str());
    return kFaulted;
  }
  return refused.empty() ? kSuccess : refuse(options, refused);
}

int Run::runVirtual() {
  rung_context& context = memory.context();
  const int64_t row_ns = schedule.rowNs();
  int64_t next_save = processorNs() + 1'000'000'000;
  int64_t next_hint = options.hint_when_long.empty() || isatty(2) == 0 ? INT64_MAX : processorNs() + kLongRunNs;
  for (int64_t row = 0; row < cycles; ++row) {
    inputs.apply(row);
    const uint8_t fault = schedule.run(row, context);
    if (options.trace_calls) fputs(calls.line(row).c_str(), options.out);
    if (fault != RUNG_FAULT_NONE) return finish(true, context.fault, "");
    if (stopper->reason() != RUNG_STOP_NONE) return finish(true, stopper->fault(), "");
    trace.row(row, row * row_ns);
    plot.row();
    rows_done = row + 1;
    if (!options.stop_on.empty() && stop_on.holds())
      return finish(false, {}, "stopped after cycle " + std::to_string(row) + ": " + options.stop_on + "\n");
    if (next_hint != INT64_MAX && processorNs() >= next_hint) {
      fprintf(options.err, "%s\n", options.hint_when_long.c_str());
      next_hint = INT64_MAX;
    }
    if (retain && row % 64 == 0 && processorNs() >= next_save) {
      const std::string refused = saveRetained();
      if (!refused.empty()) return refuse(options, refused);
      next_save = processorNs() + 1'000'000'000;
    }
  }
  return finish(false, {}, options.stop_on.empty() ? "" : "never became TRUE: " + options.stop_on + "\n");
}

int Run::runInRealTime() {
  const int64_t row_ns = schedule.rowNs();
  if (cycles == 0) return finish(false, {}, "");
  const RealtimeResult result = runRealtime(
      schedule, memory.context(), cycles, options.timeout_ns, [&](int64_t row) { inputs.apply(row); },
      [&](int64_t row) {
        trace.row(row, row * row_ns);
        plot.row();
      },
      [&] { saveRetained(); });
  rows_done = result.rows;
  if (!result.watchdog.empty() || result.hung) {
    memory.makeOutputsSafe();
    std::string error;
    trace.close(error);
    plot.close(row_ns, error);
    fflush(options.out);
    const std::string what =
        result.hung ? describeFault(memory.context(),
                                    {RUNG_FAULT_STOP, RUNG_NONE, result.faulted ? RUNG_STOP_TIME : RUNG_STOP_INTERRUPT},
                                    options.paths)
                    : "fault[watchdog]: task `" + result.watchdog + "` ran longer than its watchdog allows";
    fprintf(options.err, "%s\n", what.c_str());
    fflush(options.err);
    _exit(kFaulted);  // a thread may still be inside the program
  }
  return finish(result.faulted, result.fault, result.statistics);
}

}  // namespace

int run(const rung_module& module, const RunOptions& options) {
  if (const char* const why = refusal(module)) return refuse(options, why);
  Run run(module, options);
  const int prepared = run.prepare();
  if (prepared != kSuccess) return prepared;
  return options.realtime ? run.runInRealTime() : run.runVirtual();
}

}  // namespace rung::host
