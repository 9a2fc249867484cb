// SPDX-License-Identifier: Apache-2.0
// Console tests: .test files in tests/golden, tests/programs and tests/conformance. Line 1 is `# purpose`; a line
// `# features: 40/4a` names rows of the standard as in conformance tests. A session runs in an empty folder, with the
// tool in PATH and the project at $RUNG_SOURCE; stdout and stderr come in one stream. A line `# release only: reason`
// leaves the file out of debug builds and of those with sanitizers, `# other compilers: …` out of --quick, and
// `# debugger: …` where no process may trace another.
#include "tests/runner/console.h"

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "tests/runner/diff.h"

namespace rung::tests {
namespace {

namespace fs = std::filesystem;

void replaceAll(std::string& text, const std::string& what, const std::string& by) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

bool isExitCode(const std::string& line) {
  return line.size() > 2 && line.front() == '[' && line.back() == ']' &&
         line.find_first_not_of("0123456789", 1) == line.size() - 1;
}

Result runConsoleTest(const Setting& setting, const std::string& file) {
  Result result;
  const std::string text = readContent(setting.root + "/" + file);
  const std::vector<std::string> lines = splitLines(text);
  if (const std::string problem = purposeProblem(lines); !problem.empty()) result.fail(file, problem, "");
  std::vector<std::string> updated;
  Result session;
  runSession(setting, file, lines, freshFolder(setting), updated, session);
  result.passed += session.failed == 0 ? 1 : 0;  // a session is one test
  result.failed += session.failed == 0 ? 0 : 1;
  result.log += session.log;
  result.rows.push_back({file, "", session.failed == 0, valueOf(lines, "features"), valueOf(lines, "covers")});
  if (!setting.update) return result;
  std::string out;
  for (const std::string& line : updated) out += line + '\n';
  if (out == text) return result;
  writeContent(setting.root + "/" + file, out);
  result.log += "updated " + file + "\n";
  return result;
}

}  // namespace

void runSession(const Setting& setting, const std::string& name, const std::vector<std::string>& lines,
                const std::string& folder, std::vector<std::string>& updated, Result& result) {
  size_t i = 0;
  while (i < lines.size()) {
    if (!startsWith(lines[i], "$ ")) {  // comments and empty lines before the first command
      updated.push_back(lines[i++]);
      continue;
    }
    std::string text = lines[i].substr(2);
    updated.push_back(lines[i++]);
    while (i < lines.size() && (startsWith(lines[i], "> ") || lines[i] == ">")) {
      text += "\n" + (lines[i].size() > 2 ? lines[i].substr(2) : "");
      updated.push_back(lines[i++]);
    }
    std::vector<std::string> expected;
    while (i < lines.size() && !startsWith(lines[i], "$ ") && !startsWith(lines[i], "# "))
      expected.push_back(lines[i++]);
    std::vector<std::string> blank;  // an empty line before the next command or comment is layout
    while (!expected.empty() && expected.back().empty()) {
      blank.push_back("");
      expected.pop_back();
    }

    Command c;
    c.arguments = {"/bin/sh", "-c", text};
    c.folder = folder;
    c.merged = true;
    Output output = run(c);
    replaceAll(output.out, folder, "$PWD");
    replaceAll(output.out, setting.root, "$RUNG_SOURCE");
    std::vector<std::string> actual = splitLines(output.out);
    while (!actual.empty() && actual.back().empty()) actual.pop_back();
    if (output.exit_code != 0) actual.push_back("[" + std::to_string(output.exit_code) + "]");

    const std::string difference = diffWithGaps(expected, actual);
    const bool keeps = difference.empty();
    updated.insert(updated.end(), keeps ? expected.begin() : actual.begin(), keeps ? expected.end() : actual.end());
    updated.insert(updated.end(), blank.begin(), blank.end());
    const bool crashed = !actual.empty() && isExitCode(actual.back()) && output.exit_code >= 70;
    if (keeps || (setting.update && !crashed)) {
      result.pass();
    } else {
      result.fail(name, difference, text);
    }
  }
}

std::string folderLikeRoot(const Setting& setting) {
  std::string folder = freshFolder(setting);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(setting.root, error)) {
    const std::string name = entry.path().filename().string();
    if (name[0] != '.') fs::create_symlink(entry.path(), folder + "/" + name, error);
  }
  return folder;
}

// Tells whether a debugger may start a program here; some containers forbid it.
static bool tracesProcesses() {
  const pid_t child = fork();
  if (child == 0) _exit(ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0 ? 0 : 1);
  int status = 1;
  return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

// Why this run leaves the test out; empty: it runs.
static std::string reasonToSkip(const Setting& setting, const std::string& file) {
  const std::vector<std::string> lines = splitLines(readContent(setting.root + "/" + file));
#if defined(RUNG_SANITIZED) || !defined(NDEBUG)
  if (const std::string reason = valueOf(lines, "release only"); !reason.empty()) return reason;
#endif
  if (!valueOf(lines, "debugger").empty() && !tracesProcesses()) return "no process may trace another here";
  const std::string compilers = setting.quick ? valueOf(lines, "other compilers") : "";
  return compilers.empty() ? "" : "--quick, and it needs " + compilers;
}

void addConsole(const Setting& setting, std::vector<Job>& jobs) {
  for (const char* folder : {"tests/golden", "tests/programs", "tests/conformance"}) {
    for (const std::string& file : filesBelow(setting, folder, ".test")) {
      if (const std::string reason = reasonToSkip(setting, file); !reason.empty()) {
        std::printf("skipped %s: %s\n", file.c_str(), reason.c_str());
        continue;
      }
      jobs.push_back({file, 5, [&setting, file] { return runConsoleTest(setting, file); }});
    }
  }
}

}  // namespace rung::tests
