// SPDX-License-Identifier: Apache-2.0
// Golden tests, tests/golden/**.st and **.nct: the expected output is at the end of the test file.
//   // args: --std=iec3                                    options of every command
//   // expect: name.st:4:1: error[E0231]: ...              the output of `rung check`, heading by heading
//   // expect tree:  (or ir:)                              the output of `rung emit --emit=tree`, on `// ` lines below
//   // expect Ramp.h:                                      a file that `rung emit` writes, likewise
// A file in diagnostics/ without expectation expects no report. tests/golden/ir/*.ir belong to ir_golden.
#include <algorithm>
#include <filesystem>

#include "tests/runner/diff.h"
#include "tests/runner/support.h"

namespace rung::tests {
namespace {

namespace fs = std::filesystem;

struct Section {
  std::string name;  // "tree", "ir", or a file that emit writes
  std::vector<std::string> lines;
};

struct Golden {
  std::vector<std::string> source;  // without the expectation
  std::vector<std::string> headings;
  std::vector<Section> sections;
};

bool isSectionStart(const std::string& line) {
  return startsWith(line, "// expect ") && line.size() > 11 && line.back() == ':';
}

Golden parse(const std::vector<std::string>& lines) {
  Golden golden;
  Section* section = nullptr;
  for (const std::string& line : lines) {
    if (startsWith(line, "// expect: ")) {
      golden.headings.push_back(line.substr(11));
      section = nullptr;
    } else if (isSectionStart(line)) {
      section = &golden.sections.emplace_back();
      section->name = line.substr(10, line.size() - 11);
    } else if (section != nullptr && startsWith(line, "//")) {
      section->lines.push_back(line.size() > 3 ? line.substr(3) : "");
    } else {
      section = nullptr;
      golden.source.push_back(line);
    }
  }
  return golden;
}

std::string print(const Golden& golden) {
  std::string out;
  for (const std::string& line : golden.source) out += line + '\n';
  for (const std::string& heading : golden.headings) out += "// expect: " + heading + '\n';
  for (const Section& section : golden.sections) {
    out += "// expect " + section.name + ":\n";
    for (const std::string& line : section.lines) out += line.empty() ? "//\n" : "// " + line + '\n';
  }
  return out;
}

Command command(const Setting& setting, const std::string& file, const std::string& verb, const Golden& golden) {
  Command c;
  c.arguments = {setting.rung, verb};
  for (const std::string& word : splitWords(valueOf(golden.source, "args"))) c.arguments.push_back(word);
  c.folder = setting.root + "/" + folderOf(file);
  c.arguments.push_back(nameOf(file));
  return c;
}

void checkHeadings(const Setting& setting, const std::string& file, Golden& golden, Result& result) {
  const Command check = command(setting, file, "check", golden);
  const Output output = run(check);
  const std::vector<std::string> headings = headingsOf(output.err);
  const bool error = std::any_of(headings.begin(), headings.end(),
                                 [](const std::string& line) { return line.find(": error[") != std::string::npos; });
  std::string problem;
  if (output.exit_code != (error ? 1 : 0)) {
    problem = "  exit code " + std::to_string(output.exit_code) + "\n";
    if (headings.empty()) problem += output.err.substr(0, 2000);
  }
  if (setting.update) {
    golden.headings = headings;
  } else {
    problem += diff(golden.headings, headings);
  }
  if (problem.empty()) {
    result.pass();
  } else {
    result.fail(file, problem, commandLine(check));
  }
}

void checkSection(const Setting& setting, const std::string& file, const Golden& golden, Section& section,
                  Result& result) {
  Command emit = command(setting, file, "emit", golden);
  std::string text;
  const bool printed = section.name == "tree" || section.name == "ir";
  std::string folder;
  if (printed) {
    emit.arguments.push_back("--emit=" + section.name);
  } else {
    folder = freshFolder(setting);
    emit.arguments.insert(emit.arguments.end(), {"-o", folder});
  }
  const Output output = run(emit);
  text = printed ? output.out : readContent(folder + "/" + section.name);
  const std::vector<std::string> lines = splitLines(text);
  std::string problem;
  if (output.exit_code != 0) {
    problem = "  exit code " + std::to_string(output.exit_code) + "\n" + output.err.substr(0, 2000);
  } else if (!printed && text.empty()) {
    problem = "  emit writes no file " + section.name + "\n";
  } else if (setting.update) {
    section.lines = lines;
  } else {
    problem = diff(section.lines, lines);
  }
  if (problem.empty()) {
    result.pass();
  } else {
    result.fail(file + " (" + section.name + ")", problem, commandLine(emit));
  }
}

Result runGolden(const Setting& setting, const std::string& file) {
  Result result;
  const std::string text = readContent(setting.root + "/" + file);
  Golden golden = parse(splitLines(text));
  if (const std::string problem = purposeProblem(golden.source); !problem.empty()) result.fail(file, problem, "");

  const std::string kind = nameOf(folderOf(file));
  if (setting.update && golden.sections.empty() && kind == "tree") golden.sections.push_back({"tree", {}});
  if (golden.sections.empty() || !golden.headings.empty()) checkHeadings(setting, file, golden, result);
  for (Section& section : golden.sections) checkSection(setting, file, golden, section, result);

  if (setting.update && result.failed == 0 && print(golden) != text) {
    writeContent(setting.root + "/" + file, print(golden));
    result.log += "updated " + file + "\n";
  }
  return result;
}

// The IR has its own reader, passes and interpreter; their test program prints the difference itself.
Result runIr(const Setting& setting, const std::string& file) {
  Result result;
  Command test;
  test.arguments = {setting.bin + "/ir_golden"};
  if (setting.update) test.arguments.push_back("--update");
  test.arguments.push_back(file);
  test.folder = setting.root;
  test.merged = true;
  if (!fs::exists(test.arguments[0])) {
    result.fail(file, "  ir_golden is not built\n", "");
    return result;
  }
  const Output output = run(test);
  if (output.exit_code == 0) {
    result.pass();
  } else {
    result.fail(file, output.out, commandLine(test));
  }
  return result;
}

}  // namespace

Result runDiagnosticsTest(const Setting& setting, const std::string& file) { return runGolden(setting, file); }

void addGolden(const Setting& setting, std::vector<Job>& jobs) {
  std::vector<std::string> files = filesBelow(setting, "tests/golden", ".st");
  const std::vector<std::string> ladders = filesBelow(setting, "tests/golden", ".nct");
  files.insert(files.end(), ladders.begin(), ladders.end());
  for (const std::string& file : files) {
    jobs.push_back({file, 0, [&setting, file] { return runGolden(setting, file); }});
  }
  for (const std::string& file : filesBelow(setting, "tests/golden/ir", ".ir")) {
    jobs.push_back({file, 0, [&setting, file] { return runIr(setting, file); }});
  }
}

}  // namespace rung::tests
