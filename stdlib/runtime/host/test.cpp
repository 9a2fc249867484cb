// SPDX-License-Identifier: Apache-2.0
// `rung test`: runs the tests of a module, each from fresh memory in virtual time, and reports. A failing assertion, a
// fault or a crash fails its test only. See rung/host.h.
#include <fnmatch.h>
#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <optional>

#include "clock.h"
#include "crashes.h"
#include "faults.h"
#include "junit.h"
#include "memory.h"
#include "output_file.h"
#include "plot.h"
#include "rung/host.h"
#include "session.h"
#include "stopper.h"
#include "test_process.h"
#include "trace.h"

namespace rung::host {
namespace {

constexpr int64_t kCycleNs = 10'000'000;
constexpr int64_t kMaxCycles = 100'000;
constexpr size_t kMaxMessages = 20;        // of one test
constexpr int64_t kEndNs = 1'000'000'000;  // for FB_Exit of a test that was stopped

struct Case {
  TestResult result;
  uint64_t failures = 0;

  void fail(TestResult::Kind kind, const std::string& message) {
    if (result.kind < kind) result.kind = kind;
    if (++failures <= kMaxMessages) result.messages += message + '\n';
  }
};

bool isOfName(char c) { return c == '_' || (c >= '0' && c <= '9') || ((c | 32) >= 'a' && (c | 32) <= 'z'); }

// The source line with the assertion's name underlined, as diagnostics show it.
std::string excerpt(const rung_assertion& assertion) {
  const std::string number = std::to_string(assertion.line);
  std::string underline;
  const char* at = assertion.source;
  for (uint32_t column = 1; column < assertion.column && *at != 0; ++column) {
    underline += *at == '\t' ? '\t' : ' ';  // kept, so that the underline is aligned for any tab width
    do ++at;
    while ((*at & 0xc0) == 0x80);
  }
  underline += '^';
  while (isOfName(*at) && isOfName(*++at)) underline += '~';
  return ' ' + number + " | " + assertion.source + '\n' + std::string(number.size() + 2, ' ') + "| " + underline;
}

std::string describeViolated(const rung_assertion& assertion, const ShownPaths& paths, const char* expected,
                             const char* actual) {
  std::string message = shownPath(paths, assertion.file) + ':' + std::to_string(assertion.line);
  if (assertion.column != 0) message += ':' + std::to_string(assertion.column);
  message += ": " + describeAssertion(assertion, expected, actual);
  if (assertion.source != nullptr) message += '\n' + excerpt(assertion);
  return message;
}

// The running test, for signal handlers. They allocate, but the interrupted code runs no more: at worst the process
// dies without the note.
char* where_of_test = nullptr;
const ShownPaths* paths_of_test = nullptr;
const TestResult* result_of_test = nullptr;
void noteWhere(const rung_context* context, const std::string& what) {
  const TestResult& test = *result_of_test;
  const bool in_cpp = context != nullptr && context->cpp_body != nullptr;
  const std::string where =
      in_cpp ? describeCppBody(*context, *paths_of_test, what)
             : test.shown_file + ':' + std::to_string(test.line) + ": " + what + " in `" + test.name + '`';
  const size_t size = std::min(where.size(), kWhereSize - 1);
  std::copy_n(where.data(), size, where_of_test);
  where_of_test[size] = '\0';
}
void onHung(const rung_context* context, uint8_t reason) {
  noteWhere(context, reason == RUNG_STOP_TIME ? "fault[time]: the time limit is reached (--timeout)"
                                              : "fault[interrupt]: interrupted");
  raise(SIGKILL);
}
void onCrash(const char* signal) { noteWhere(runningContext(), std::string("crash: ") + signal); }

SessionOptions sessionOptions(const TestOptions& options) {
  SessionOptions wanted;
  wanted.interval_ns = kCycleNs;
  wanted.max_steps = options.max_steps;
  wanted.is_isolated = true;
  return wanted;
}

class TestRunner {
 public:
  TestRunner(const rung_module& module, const TestOptions& options)
      : options_(options),
        session_(module, sessionOptions(options), hooks()),
        module_(session_.module()),
        trace_(session_.symbols()),
        plot_(module_) {}

  TestResult describe(uint32_t number) const {
    const rung_test& test = module_.tests[number];
    TestResult result;
    result.name = module_.strings + test.name;
    result.file = module_.strings + test.file;
    result.shown_file = shownPath(options_.paths, result.file);
    result.line = test.line;
    return result;
  }

  bool interrupted() const { return interrupted_; }

  // Chooses what --trace and --plot show of a test: its own variables, or those of --watch. Returns an error message,
  // or an empty string.
  std::string chooseVariables(uint32_t number) {
    std::string error, test = module_.strings + module_.tests[number].name;
    test.resize(std::min(test.find('('), test.size()));  // without the values of a case
    if (!options_.watch.empty() && !trace_.choose(options_.watch, Trace::Use::Rows, error)) return "--watch: " + error;
    if (options_.watch.empty() && !trace_.chooseProgram(test, error))
      return "the test `" + test + "` is a function and keeps no variables; give --watch, or make it a PROGRAM";
    return "";
  }

  TestResult run(uint32_t number, char* where) {
    Case one{describe(number)};
    running_ = &one;
    paths_of_test = &options_.paths;
    result_of_test = &one.result;
    where_of_test = where;
    const int64_t begin_ns = monotonicNs();
    {
      Stopper stopper(session_.context(), onHung);
      stopper.limitTime(options_.timeout_ns);
      session_.chooseTest(number);
      runCase(stopper);
      interrupted_ = stopper.reason() == RUNG_STOP_INTERRUPT;
    }
    one.result.seconds = static_cast<double>(monotonicNs() - begin_ns) / 1e9;
    if (one.failures > kMaxMessages)
      one.result.messages += "and " + std::to_string(one.failures - kMaxMessages) + " more\n";
    return std::move(one.result);
  }

 private:
  SessionHooks hooks() {
    SessionHooks hooks;
    hooks.assertion = [this](const rung_assertion& assertion, bool passed, const char* expected, const char* actual) {
      ++running_->result.assertions;
      if (!passed) running_->fail(TestResult::Failed, describeViolated(assertion, options_.paths, expected, actual));
    };
    return hooks;
  }

  bool faulted(const Ending& ending) {
    if (!ending.isComplete())
      running_->fail(TestResult::Broken, describeFault(session_.context(), ending.fault, options_.paths));
    return !ending.isComplete();
  }

  // Sets up the memory as for a program, runs the test, and ends all objects (FB_Exit), after a fault too.
  void runCase(Stopper& stopper) {
    if (faulted(session_.init())) return;
    std::string error;
    const bool is_open =
        trace_.open(options_.trace_path, options_.out, error) &&
        (options_.plot_path.empty() || plot_.open(options_.plot_path, options_.out, trace_.variables(), error));
    if (is_open) runCycles(stopper);
    if (!is_open || !trace_.close(error) || !plot_.close(kCycleNs, error))
      running_->fail(TestResult::Broken, "error: " + error);
    if (stopper.reason() != RUNG_STOP_NONE) stopper.limitTime(kEndNs);
    faulted(session_.endTest());
    faulted(session_.end());
  }

  void runCycles(const Stopper& stopper) {
    const rung_context& context = session_.context();
    if (faulted(session_.begin())) return;
    int64_t advanced = 0;  // rows that the test has skipped
    for (int64_t cycle = 0; cycle < kMaxCycles; ++cycle) {
      if (faulted(session_.cycle())) return;
      trace_.row(cycle, context.now_ns);
      plot_.row();
      plot_.hold(context.now_ns / kCycleNs - cycle - advanced);
      advanced = context.now_ns / kCycleNs - cycle;
      session_.completeCycle();
      if (stopper.reason() != RUNG_STOP_NONE) {  // seen by no poll
        running_->fail(TestResult::Broken, describeFault(context, stopper.fault(), options_.paths));
        return;
      }
      if (session_.isDone()) return;
    }
    const TestResult& result = running_->result;
    running_->fail(TestResult::Failed, result.shown_file + ':' + std::to_string(result.line) +
                                           ": `done` is still FALSE after " + std::to_string(kMaxCycles) + " cycles");
  }

  const TestOptions& options_;
  Case* running_ = nullptr;
  Session session_;
  const LoadedModule& module_;
  Trace trace_;
  Plot plot_;
  bool interrupted_ = false;
};

const char* wordOf(TestResult::Kind kind) {
  switch (kind) {
    case TestResult::Passed: return "pass";
    case TestResult::Skipped: return "skip";
    case TestResult::Failed:
    case TestResult::Broken: break;
  }
  return "FAIL";
}

void report(TestResult result, const TestOptions& options, TestResults& results) {
  const bool skipped = result.kind == TestResult::Skipped;
  ++(skipped ? results.skipped : result.kind == TestResult::Passed ? results.passed : results.failed);
  if (!skipped) fputs(result.messages.c_str(), options.out);
  fprintf(options.out, "%s %s%s%s\n", wordOf(result.kind), result.name.c_str(), skipped ? ": " : "",
          skipped ? result.messages.c_str() : "");
  fflush(options.out);
  results.seconds += result.seconds;
  results.tests.push_back(std::move(result));
}

}  // namespace

bool isChosen(const TestOptions& options, const std::string& name) {
  const std::string of_case = lowerCase(name), of_all = of_case.substr(0, of_case.find('('));
  return options.filters.empty() ||
         std::any_of(options.filters.begin(), options.filters.end(), [&](const std::string& filter) {
           const std::string glob = lowerCase(filter);
           return glob == of_case || fnmatch(glob.c_str(), of_case.c_str(), 0) == 0 ||
                  fnmatch(glob.c_str(), of_all.c_str(), 0) == 0;
         });
}

std::string runTests(const rung_module& module, const TestOptions& options, TestResults& results) {
  if (const char* const why = refusal(module)) return why;
  if (results.interrupted) return "";
  TestRunner runner(module, options);
  std::vector<uint32_t> chosen;
  for (uint32_t i = 0; i < module.tests.count; ++i) {
    const std::string name = module.strings + rung_test_at(&module, i)->name;
    if (!isChosen(options, name)) continue;
    const auto skip = options.skipped.find(name);
    if (skip == options.skipped.end()) {
      chosen.push_back(i);
      continue;
    }
    TestResult result = runner.describe(i);
    result.kind = TestResult::Skipped;
    result.messages = skip->second;
    report(std::move(result), options, results);
  }
  if (!options.trace_path.empty() || !options.plot_path.empty()) {
    if (chosen.size() + results.count() > 1) return "--trace and --plot show one test; choose it with --filter";
    if (!chosen.empty())
      if (const std::string error = runner.chooseVariables(chosen.front()); !error.empty()) return error;
  }
  const TestProcess process = {
      [&](uint32_t test, char* where) { return runner.run(test, where); },
      [&] { return runner.interrupted(); },
      onCrash,
      [&](uint32_t test) { return runner.describe(test); },
      [&](TestResult result) { report(std::move(result), options, results); },
  };
  return chosen.empty() ? "" : runInChildren(chosen, options, process, results);
}

std::string writeJunit(const TestResults& results, const std::string& path, std::FILE* out) {
  OutputFile file;
  std::string error;
  if (!file.open(path, out, error)) return error;
  file.write(junitXml(results));
  file.close(error);
  return error;
}

int reportTests(const TestResults& results, const TestOptions& options) {
  fprintf(options.out, "%u passed, %u failed", results.passed, results.failed);
  if (results.skipped != 0) fprintf(options.out, ", %u skipped", results.skipped);
  fprintf(options.out, "%s\n", results.interrupted ? "; interrupted, the other tests did not run" : "");
  fflush(options.out);
  if (!options.junit_path.empty()) {
    const std::string error = writeJunit(results, options.junit_path, options.out);
    if (!error.empty()) {
      fprintf(options.err, "error: %s\n", error.c_str());
      return 2;
    }
  }
  return results.failed == 0 && !results.interrupted ? 0 : 4;
}

int test(const rung_module& module, const TestOptions& options) {
  TestResults results;
  const std::string problem = runTests(module, options, results);
  if (problem.empty()) return reportTests(results, options);
  fprintf(options.err, "error: %s\n", problem.c_str());
  return 2;
}

}  // namespace rung::host
