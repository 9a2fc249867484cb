// `rung test`: runs the tests of a module, each from fresh memory in virtual time, and reports. A failing assertion or
// a fault fails its test only. See rung/host.h.
#include <fnmatch.h>
#include <unistd.h>
#include <chrono>
#include <cstdio>
#include <functional>

#include "crashes.h"
#include "faults.h"
#include "junit.h"
#include "memory.h"
#include "output_file.h"
#include "rung/host.h"
#include "symbols.h"

namespace rung::host {
namespace {

constexpr int64_t kCycleNs = 10'000'000;
constexpr int64_t kMaxCycles = 100'000;
constexpr size_t kMaxMessages = 20;  // of one test
constexpr double kLongSeconds = 3;   // tests that a faster engine would shorten

struct Case {
  rung_context* context;
  TestResult result;
  uint64_t failures = 0;

  void fail(TestResult::Kind kind, const std::string& message) {
    if (result.kind < kind) result.kind = kind;
    if (++failures <= kMaxMessages) result.messages += message + '\n';
  }
};

int64_t testClock(void* data) { return static_cast<Case*>(data)->context->now_ns; }

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

void onTestAssertion(void* data, const rung_assertion* assertion, bool passed, const char* expected,
                     const char* actual) {
  Case& test = *static_cast<Case*>(data);
  ++test.result.assertions;
  if (passed) return;
  std::string message = std::string(assertion->file) + ':' + std::to_string(assertion->line);
  if (assertion->column != 0) message += ':' + std::to_string(assertion->column);
  message += std::string(": assertion failed: expected ") + expected + ", got " + actual;
  if (assertion->message != nullptr) message += std::string(" (") + assertion->message + ')';
  if (assertion->source != nullptr) message += '\n' + excerpt(*assertion);
  test.fail(TestResult::Failed, message);
}

void runCycles(const rung_module& module, const rung_test& test, Memory& memory, Case& result,
               const std::function<bool(uint8_t)>& faulted, const std::function<void()>& onCycle) {
  rung_context& context = memory.context();
  if (test.init != nullptr && faulted(guarded(&context, test.init))) return;
  const bool has_done = test.done_block != RUNG_NONE;
  for (int64_t cycle = 0; cycle < kMaxCycles; ++cycle) {
    if (cycle > 0) context.now_ns += kCycleNs;  // the test may have moved it: TEST_ADVANCE
    context.activation = static_cast<uint32_t>(cycle) + 1;
    if (faulted(guarded(&context, test.run))) return;
    if (!has_done || memory.block(test.done_block)[test.done_offset] != 0) return;
    onCycle();
  }
  result.fail(TestResult::Failed, std::string(module.strings + test.file) + ':' + std::to_string(test.line) +
                                      ": `done` is still FALSE after " + std::to_string(kMaxCycles) + " cycles");
}

// Sets up the memory as for a program, runs the test, and ends all objects (FB_Exit), after a fault too.
void runCase(const rung_module& module, const rung_test& test, Memory& memory, Case& result,
             const std::function<void()>& onCycle) {
  rung_context& context = memory.context();
  const auto faulted = [&](uint8_t kind) {
    if (kind != RUNG_FAULT_NONE) result.fail(TestResult::Broken, describeFault(module, context.fault));
    return kind != RUNG_FAULT_NONE;
  };
  if (faulted(memory.reset())) return;
  context.entry = &test;
  context.task = 1;
  runCycles(module, test, memory, result, faulted, onCycle);
  if (test.exit != nullptr) faulted(guarded(&context, test.exit));
  faulted(memory.end());
}

}  // namespace

bool isChosen(const TestOptions& options, const std::string& name) {
  return options.filter.empty() || fnmatch(lowerCase(options.filter).c_str(), lowerCase(name).c_str(), 0) == 0;
}

std::string runTests(const rung_module& module, const TestOptions& options, TestResults& results) {
  if (const char* const why = refusal(module)) return why;
  Memory memory(module);
  rung_host host{};
  host.wall_clock = testClock;
  host.assertion = onTestAssertion;
  memory.context().host = &host;

  for (uint32_t i = 0; i < module.test_count; ++i) {
    const rung_test& test = module.tests[i];
    const char* const name = module.strings + test.name;
    if (!isChosen(options, name)) continue;
    Case one{&memory.context(), {}};
    one.result.name = name;
    one.result.file = module.strings + test.file;
    one.result.line = test.line;
    memory.context().host_data = &one;
    const auto begin = std::chrono::steady_clock::now();
    const auto onCycle = [&] {
      one.result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      if (results.hinted || options.hint_when_long.empty() || isatty(2) == 0) return;
      results.hinted = results.seconds + one.result.seconds >= kLongSeconds;
      if (results.hinted) fprintf(options.err, "%s\n", options.hint_when_long.c_str());
    };
    runCase(module, test, memory, one, onCycle);
    onCycle();
    if (one.failures > kMaxMessages)
      one.result.messages += "and " + std::to_string(one.failures - kMaxMessages) + " more\n";
    const bool ok = one.result.kind == TestResult::Passed;
    ++(ok ? results.passed : results.failed);
    fputs(one.result.messages.c_str(), options.out);
    fprintf(options.out, "%s %s\n", ok ? "pass" : "FAIL", name);
    results.seconds += one.result.seconds;
    results.tests.push_back(std::move(one.result));
  }
  return "";
}

int reportTests(const TestResults& results, const TestOptions& options) {
  fprintf(options.out, "%u passed, %u failed\n", results.passed, results.failed);
  fflush(options.out);
  if (!options.junit_path.empty()) {
    OutputFile file;
    std::string error;
    bool ok = file.open(options.junit_path, options.out, error);
    if (ok) {
      file.write(junitXml(results));
      ok = file.close(error);
    }
    if (!ok) {
      fprintf(options.err, "error: %s\n", error.c_str());
      return 2;
    }
  }
  return results.failed == 0 ? 0 : 4;
}

int test(const rung_module& module, const TestOptions& options) {
  TestResults results;
  const std::string problem = runTests(module, options, results);
  if (problem.empty()) return reportTests(results, options);
  fprintf(options.err, "error: %s\n", problem.c_str());
  return 2;
}

}  // namespace rung::host
