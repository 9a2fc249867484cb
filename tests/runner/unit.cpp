// SPDX-License-Identifier: Apache-2.0
// Unit tests (the GoogleTest programs that CMake lists in unit_tests.list), a fixed share of the differential tests and
// of the library bodies that some test must miss, what finds the mutants of the compiler, and the checks of
// tools/house/checks.
#include <cstdlib>

#include "tests/runner/diff.h"
#include "tests/runner/support.h"

namespace rung::tests {
namespace {

// N of a line like "[  PASSED  ] N tests."
unsigned countAfter(const std::string& text, const std::string& mark) {
  const size_t at = text.find(mark);
  return at == std::string::npos ? 0
                                 : static_cast<unsigned>(std::strtoul(text.c_str() + at + mark.size(), nullptr, 10));
}

Result runUnit(const Setting& setting, const std::string& name) {
  Command c;
  c.arguments = {setting.bin + "/" + name, "--gtest_brief=1"};
  c.folder = setting.root;
  c.merged = true;
  c.seconds = 600;
  const Output output = run(c);
  Result result;
  result.passed = countAfter(output.out, "[  PASSED  ] ");
  const unsigned failed = countAfter(output.out, "[  FAILED  ] ");
  if (output.exit_code == 0 && failed == 0) return result;
  result.fail("unit/" + name, output.out.substr(0, 8000), commandLine(c));
  if (failed > 1) result.failed = failed;
  return result;
}

// The same programs in each run; more, with other seeds and compilers, are run by hand. With sanitizers a tenth of
// them: each would compile for half a minute.
Result runDifferential(const Setting& setting, const std::string& name, std::vector<std::string> options,
                       unsigned count) {
  if (kSanitized) count /= 10;
  Command c;
  c.arguments = {setting.bin + "/" + name, "--count=" + std::to_string(count), "--folder=" + freshFolder(setting)};
  c.arguments.insert(c.arguments.end(), options.begin(), options.end());
  c.folder = setting.root;
  c.merged = true;
  c.seconds = 600;
  const Output output = run(c);
  Result result;
  if (output.exit_code == 0) {
    result.passed = count;
  } else {
    result.fail("unit/" + name, output.out.substr(0, 8000), commandLine(c));
  }
  return result;
}

// A program that exits with 0, or fails with what it prints.
Result runScript(const Setting& setting, const std::string& name, std::vector<std::string> arguments) {
  Command c;
  c.arguments = std::move(arguments);
  c.folder = setting.root;
  c.seconds = 600;
  c.merged = true;
  const Output output = run(c);
  Result result;
  if (output.exit_code == 0) {
    result.pass();
  } else {
    result.fail(name, output.out.substr(0, 4000), commandLine(c));
  }
  return result;
}

}  // namespace

void addUnit(const Setting& setting, std::vector<Job>& jobs) {
  if (setting.update) return;
  for (const std::string& name : splitLines(readContent(setting.bin + "/../unit_tests.list"))) {
    if (name.empty() || !isWanted(setting, "unit/" + name)) continue;
    jobs.push_back({"unit/" + name, 5, [&setting, name] { return runUnit(setting, name); }});
  }
  if (isWanted(setting, "unit/differential")) {
    // A sanitized rung cannot load what another compiler has made.
    const std::string ways = kSanitized ? "--ways=interp" : "--ways=suite";
    jobs.push_back({"unit/differential", 10, [&setting, ways] {
                      return runDifferential(setting, "differential", {ways, "-j2"}, 200);
                    }});
  }
  if (isWanted(setting, "unit/il_differential")) {
    jobs.push_back({"unit/il_differential", 8, [&setting] {
                      return runDifferential(setting, "il_differential", {"--cycles=2000", "-j2"}, 100);
                    }});
  }
  if (isWanted(setting, "unit/sfc_differential"))
    jobs.push_back(
        {"unit/sfc_differential", 5, [&setting] { return runDifferential(setting, "sfc_differential", {}, 20); }});
  if (isWanted(setting, "unit/network_differential"))
    jobs.push_back({"unit/network_differential", 5, [&setting] {
                      return runDifferential(setting, "network_differential", {"--cycles=200", "-j2"}, 40);
                    }});
  // What follows asks whether tests notice mistakes.
  if (!kSanitized && isWanted(setting, "unit/bodies"))
    jobs.push_back({"unit/bodies", 15, [&setting] {
                      return runScript(setting, "unit/bodies",
                                       {"/usr/bin/env", "BUILD=" + setting.bin + "/..",
                                        setting.root + "/tests/bodies/bodies.py", "--sample", "-j", "1"});
                    }});
  if (!kSanitized && isWanted(setting, "unit/mutants"))
    jobs.push_back(
        {"unit/mutants", 5, [&setting] {
           return runScript(setting, "unit/mutants", {setting.root + "/tests/mutation/mutation.py", "--sample"});
         }});
  for (const std::string& script : filesBelow(setting, "tools/house/checks", ".sh")) {
    jobs.push_back(
        {script, 2, [&setting, script] { return runScript(setting, script, {setting.root + "/" + script}); }});
  }
}

}  // namespace rung::tests
