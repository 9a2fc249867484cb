// SPDX-License-Identifier: Apache-2.0
// Test results as JUnit XML: see junit.h.
#include "junit.h"

#include <cstdio>
#include <string_view>

namespace rung::host {
namespace {

std::string escaped(std::string_view text) {
  std::string to;
  for (const char c : text) {
    switch (c) {
      case '&': to += "&amp;"; break;
      case '<': to += "&lt;"; break;
      case '>': to += "&gt;"; break;
      case '"': to += "&quot;"; break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n')
          to += '?';  // XML 1.0 does not allow this character
        else
          to += c;
    }
  }
  return to;
}

std::string attribute(const char* name, std::string_view value) {
  return std::string(" ") + name + "=\"" + escaped(value) + '"';
}
std::string attribute(const char* name, uint64_t value) { return attribute(name, std::to_string(value)); }
std::string attribute(const char* name, double seconds) {
  char text[32];
  snprintf(text, sizeof text, "%.6f", seconds);
  return attribute(name, std::string_view(text));
}

// `tests/level.st` is the class `tests.level`: readers take the part before the last dot as the package.
std::string className(const std::string& file) {
  std::string name = file.substr(0, file.find_last_of('.'));
  for (char& c : name)
    if (c == '/') c = '.';
  return name;
}

struct Totals {
  uint64_t tests = 0, failures = 0, errors = 0, skipped = 0;
  double seconds = 0;

  void add(const TestResult& test) {
    ++tests;
    failures += test.kind == TestResult::Failed;
    errors += test.kind == TestResult::Broken;
    skipped += test.kind == TestResult::Skipped;
    seconds += test.seconds;
  }
  std::string attributes() const {
    return attribute("tests", tests) + attribute("failures", failures) + attribute("errors", errors) +
           attribute("skipped", skipped) + attribute("time", seconds);
  }
};

std::string caseElement(const TestResult& test) {
  std::string out = "    <testcase" + attribute("name", test.name) + attribute("classname", className(test.file)) +
                    attribute("file", test.shown_file) + attribute("line", uint64_t{test.line}) +
                    attribute("assertions", test.assertions) + attribute("time", test.seconds);
  if (test.kind == TestResult::Passed) return out + "/>\n";
  if (test.kind == TestResult::Skipped)
    return out + ">\n      <skipped" + attribute("message", test.messages) + "/>\n    </testcase>\n";
  const char* const element = test.kind == TestResult::Failed ? "failure" : "error";
  return out + ">\n      <" + element + attribute("message", test.messages.substr(0, test.messages.find('\n'))) + '>' +
         escaped(test.messages) + "</" + element + ">\n    </testcase>\n";
}

}  // namespace

std::string junitXml(const TestResults& results) {
  Totals all;
  std::string suites;
  std::vector<bool> written(results.tests.size());
  for (size_t first = 0; first < results.tests.size(); ++first) {
    if (written[first]) continue;
    const std::string& file = results.tests[first].file;
    Totals of_file;
    std::string cases, output;
    for (size_t i = first; i < results.tests.size(); ++i) {
      const TestResult& test = results.tests[i];
      if (test.file != file) continue;
      written[i] = true;
      all.add(test);
      of_file.add(test);
      cases += caseElement(test);
      if (test.kind == TestResult::Skipped)
        output += "skip " + test.name + ": " + test.messages + '\n';
      else
        output += test.messages + (test.kind == TestResult::Passed ? "pass " : "FAIL ") + test.name + '\n';
    }
    suites += "  <testsuite" + attribute("name", results.tests[first].shown_file) + of_file.attributes() + ">\n" +
              cases + "    <system-out>" + escaped(output) + "</system-out>\n  </testsuite>\n";
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"rung\"" + all.attributes() + ">\n" + suites +
         "</testsuites>\n";
}

}  // namespace rung::host
