// `rung test`: runs the tests of a module, each from fresh memory in virtual time, and reports (design §11). A failing
// assertion or a fault fails its test and no other. See rung/host.h.
#include <fnmatch.h>
#include <cstdio>

#include "faults.h"
#include "memory.h"
#include "output_file.h"
#include "rung/host.h"
#include "symbols.h"

namespace rung::host {
namespace {

constexpr int64_t kCycleNs = 10'000'000;
constexpr int64_t kMostCycles = 100'000;
constexpr size_t kMostMessages = 20;  // of one test

struct Case {
  rung_context* context;
  uint64_t assertions = 0, failures = 0;
  std::string messages;

  void fail(const std::string& message) {
    if (++failures <= kMostMessages) messages += message + '\n';
  }
};

int64_t testClock(void* data) { return static_cast<Case*>(data)->context->now_ns; }

void onAssertion(void* data, bool passed, const char* file, uint32_t line, const char* expected, const char* actual,
                 const char* text) {
  Case& test = *static_cast<Case*>(data);
  ++test.assertions;
  if (passed) return;
  std::string message =
      std::string(file) + ':' + std::to_string(line) + ": assertion failed: expected " + expected + ", got " + actual;
  if (text != nullptr && *text != 0) message += std::string(" (") + text + ')';
  test.fail(message);
}

void runCase(const rung_module& module, const rung_test& test, Memory& memory, Case& result) {
  rung_context& context = memory.context();
  const auto faulted = [&](uint8_t kind) {
    if (kind != RUNG_FAULT_NONE) result.fail(describeFault(module, context.fault));
    return kind != RUNG_FAULT_NONE;
  };
  if (faulted(memory.reset())) return;
  context.entry = &test;
  if (test.init != nullptr && faulted(rung_guarded(&context, test.init))) return;
  const bool has_done = test.done_block != RUNG_NONE;
  for (int64_t cycle = 0; cycle < kMostCycles; ++cycle) {
    if (cycle > 0) context.now_ns += kCycleNs;  // the test may have moved it: TEST_ADVANCE
    if (faulted(rung_guarded(&context, test.run))) return;
    if (!has_done || memory.block(test.done_block)[test.done_offset] != 0) return;
  }
  result.fail(std::string(module.text + test.file) + ':' + std::to_string(test.line) +
              ": `done` is still FALSE after " + std::to_string(kMostCycles) + " cycles");
}

void appendXml(std::string& to, std::string_view text) {
  for (const char c : text) {
    switch (c) {
      case '&': to += "&amp;"; break;
      case '<': to += "&lt;"; break;
      case '>': to += "&gt;"; break;
      case '"': to += "&quot;"; break;
      case '\n': to += "&#10;"; break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 && c != '\t')
          to += '?';  // XML 1.0 has no such character
        else
          to += c;
    }
  }
}

std::string counts(uint32_t passed, uint32_t failed) {
  return " tests=\"" + std::to_string(passed + failed) + "\" failures=\"" + std::to_string(failed) + '"';
}

}  // namespace

std::string runTests(const rung_module& module, const TestOptions& options, TestResults& results) {
  if (const char* const why = refusal(module)) return why;
  Memory memory(module);
  rung_host host{};
  host.wall_clock = testClock;
  host.assertion = onAssertion;
  memory.context().host = &host;

  uint32_t passed = 0, failed = 0;
  std::string junit;
  const std::string glob = lowerCase(options.filter);
  for (uint32_t i = 0; i < module.test_count; ++i) {
    const rung_test& test = module.tests[i];
    const char* const name = module.text + test.name;
    if (!glob.empty() && fnmatch(glob.c_str(), lowerCase(name).c_str(), 0) != 0) continue;
    Case result{&memory.context(), 0, 0, {}};
    memory.context().host_data = &result;
    runCase(module, test, memory, result);
    const bool good = result.failures == 0;
    ++(good ? passed : failed);
    if (result.failures > kMostMessages)
      result.messages += "and " + std::to_string(result.failures - kMostMessages) + " more\n";
    fputs(result.messages.c_str(), stdout);
    printf("%s %s\n", good ? "pass" : "FAIL", name);

    junit += "    <testcase name=\"";
    appendXml(junit, name);
    junit += "\" classname=\"";
    appendXml(junit, module.text + test.file);
    junit += "\" file=\"";
    appendXml(junit, module.text + test.file);
    junit += "\" line=\"" + std::to_string(test.line) + "\" assertions=\"" + std::to_string(result.assertions) + '"';
    if (good) {
      junit += "/>\n";
    } else {
      junit += ">\n      <failure message=\"";
      appendXml(junit, result.messages.substr(0, result.messages.find('\n')));
      junit += "\">";
      appendXml(junit, result.messages);
      junit += "</failure>\n    </testcase>\n";
    }
  }
  results.passed += passed;
  results.failed += failed;
  results.junit += "  <testsuite name=\"";
  appendXml(results.junit, module.name);
  results.junit += '"' + counts(passed, failed) + ">\n" + junit + "  </testsuite>\n";
  return "";
}

std::string brokenSuite(const std::string& file, const std::string& messages) {
  std::string name, text, out;
  appendXml(name, file);
  appendXml(text, messages);
  out = "  <testsuite name=\"" + name + '"' + counts(0, 1) + ">\n    <testcase name=\"compile\" classname=\"" + name +
        "\" file=\"" + name + "\">\n      <failure message=\"does not compile\">" + text +
        "</failure>\n    </testcase>\n  </testsuite>\n";
  return out;
}

int reportTests(const TestResults& results, const TestOptions& options) {
  printf("%u passed, %u failed\n", results.passed, results.failed);
  fflush(stdout);
  if (!options.junit_path.empty()) {
    const std::string junit = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
                              counts(results.passed, results.failed) + ">\n" + results.junit + "</testsuites>\n";
    OutputFile file;
    std::string error;
    bool good = file.open(options.junit_path, error);
    if (good) {
      file.write(junit);
      good = file.close(error);
    }
    if (!good) {
      fprintf(stderr, "error: %s\n", error.c_str());
      return 2;
    }
  }
  return results.failed == 0 ? 0 : 4;
}

int test(const rung_module& module, const TestOptions& options) {
  TestResults results;
  const std::string wrong = runTests(module, options, results);
  if (wrong.empty()) return reportTests(results, options);
  fprintf(stderr, "error: %s\n", wrong.c_str());
  return 2;
}

}  // namespace rung::host
