// SPDX-License-Identifier: Apache-2.0
// Programs with an expected trace, tests/programs/**.st and **.xml, or a folder with test.txt and a project:
//   // run: --cycles 5 --watch a,b     options of `rung run`; --trace - is added
//   // trace: cycle,time_ms,a,b        the expected CSV, line by line, computed by hand or from a manual
//   // restart: 2                      cycles before a warm start, after which the trace begins; --set is for these
//   alone
//   // exit: 3                         when the program faults; `// expect:` then gives the heading on stderr
// Each program runs once for each way (interpreted and compiled, -O0 and -O1).
#include <algorithm>
#include <filesystem>

#include "tests/runner/diff.h"
#include "tests/runner/support.h"

namespace rung::tests {
namespace {

Result runProgram(const Setting& setting, const std::string& file) {
  Result result;
  const std::vector<std::string> lines = splitLines(readContent(setting.root + "/" + file));
  if (const std::string problem = purposeProblem(lines); !problem.empty()) result.fail(file, problem, "");
  const std::string exit_value = valueOf(lines, "exit");
  const int exit_code = exit_value.empty() ? 0 : std::stoi(exit_value);
  const bool folder = nameOf(file) == "test.txt";

  for (const std::string& way : setting.ways) {
    Command c;
    c.arguments = {setting.rung, "run", folder ? "." : nameOf(file)};
    for (const std::string& word : splitWords(way + " " + valueOf(lines, "run"))) c.arguments.push_back(word);
    if (std::find(c.arguments.begin(), c.arguments.end(), "--trace") == c.arguments.end()) {
      c.arguments.insert(c.arguments.end(), {"--trace", "-"});
    }
    c.folder = setting.root + "/" + folderOf(file);
    if (const std::string cycles = valueOf(lines, "restart"); !cycles.empty()) {
      c.arguments.insert(c.arguments.end(), {"--retain", freshFolder(setting) + "/state"});
      Command before = c;
      const auto count = std::find(before.arguments.begin(), before.arguments.end(), "--cycles");
      if (count != before.arguments.end()) *(count + 1) = cycles;
      run(before);
      while (true) {
        const auto set = std::find(c.arguments.begin(), c.arguments.end(), "--set");
        if (set == c.arguments.end()) break;
        c.arguments.erase(set, set + 2);
      }
    }
    const Output output = run(c);
    std::string problem;
    if (output.exit_code != exit_code) {
      problem = "  exit code " + std::to_string(output.exit_code) + ", expected " + std::to_string(exit_code) + "\n" +
                output.err.substr(0, 4000);
    }
    problem += diff(valuesOf(lines, "trace"), splitLines(output.out));
    const std::vector<std::string> headings = valuesOf(lines, "expect");
    if (!headings.empty()) problem += diff(headings, headingsOf(output.err));
    if (problem.empty()) {
      result.pass();
    } else {
      result.fail(file + " (" + way + ")", problem, commandLine(c));
    }
  }
  result.rows.push_back({file, "", result.failed == 0, valueOf(lines, "features"), valueOf(lines, "covers")});
  return result;
}

}  // namespace

void addPrograms(const Setting& setting, std::vector<Job>& jobs) {
  if (setting.update) return;  // traces are asserted values
  std::vector<std::string> files = filesBelow(setting, "tests/programs", "/test.txt");
  const std::vector<std::string> projects = files;
  for (const std::string& file : filesBelow(setting, "tests/programs", ".st")) {
    const bool part = std::any_of(projects.begin(), projects.end(), [&](const std::string& project) {
      return startsWith(file, folderOf(project) + "/");
    });
    if (!part) files.push_back(file);
  }
  for (const std::string& file : filesBelow(setting, "tests/programs", ".xml"))
    if (!valuesOf(splitLines(readContent(setting.root + "/" + file)), "trace").empty()) files.push_back(file);
  for (const std::string& file : files) {
    jobs.push_back(
        {file, 2 * static_cast<int>(setting.ways.size()), [&setting, file] { return runProgram(setting, file); }});
  }
}

}  // namespace rung::tests
