// SPDX-License-Identifier: Apache-2.0
// Shared by all kinds of tests: paths, the list of jobs, expectations written in test files.
// A job is one process or a batch of them; it counts as many tests as it reports.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/runner/process.h"

namespace rung::tests {

struct Setting {
  std::string root;                 // of the project
  std::string bin;                  // programs under test
  std::string rung;                 // bin/rung
  std::string scratch;              // made for this run, removed when all tests pass
  bool update = false;              // --update: rewrite golden text
  bool quick = false;               // --quick: without the tests that need compilers for other processors
  std::vector<std::string> ways;    // options that programs and tests are run with, one run each
  std::vector<std::string> wanted;  // FILE arguments, relative to the root; empty: everything
};

// One row of test-results.tsv, from which docs/compliance*.md are made.
struct Row {
  std::string file, test;
  bool passed;
  std::string features, covers;
};

struct Result {
  unsigned passed = 0, failed = 0;
  std::string log;  // printed when not empty
  std::vector<Row> rows;

  void pass() { ++passed; }
  // Reports one failed test: its name, the problem (a diff), and the command that reproduces it.
  void fail(const std::string& test, const std::string& what, const std::string& command);
};

struct Job {
  std::string name;
  int cost;  // roughly seconds: long jobs start first
  std::function<Result()> run;
};

// Each adds the jobs of its kind of test.
void addGolden(const Setting& setting, std::vector<Job>& jobs);
void addConformance(const Setting& setting, std::vector<Job>& jobs);
void addPrograms(const Setting& setting, std::vector<Job>& jobs);
void addConsole(const Setting& setting, std::vector<Job>& jobs);
void addDiagrams(const Setting& setting, std::vector<Job>& jobs);
void addDocumentation(const Setting& setting, std::vector<Job>& jobs);
void addUnit(const Setting& setting, std::vector<Job>& jobs);

// ---- files

std::string readContent(const std::string& path);
bool writeContent(const std::string& path, const std::string& text);
// All files below root/folder that end in `ending` and are wanted, sorted, relative to the root.
std::vector<std::string> filesBelow(const Setting& setting, const std::string& folder, const std::string& ending);
bool isWanted(const Setting& setting, const std::string& path);
std::string folderOf(const std::string& path);
std::string nameOf(const std::string& path);
std::string freshFolder(const Setting& setting);

// ---- test files

// `// key: value` lines of a test file, in order; also `; key: value` (IR) and `<!-- key: value -->` (XML).
std::vector<std::string> valuesOf(const std::vector<std::string>& lines, const std::string& key);
std::string valueOf(const std::vector<std::string>& lines, const std::string& key);
// Words of a line as a shell splits them: blanks separate, quotes group.
std::vector<std::string> splitWords(const std::string& text);
bool startsWith(const std::string& text, const std::string& prefix);
std::string trimmed(const std::string& text);

// The headings among what rung printed: `path:line:col: error[E0412]: …`, notes, faults, the count of hidden errors.
std::vector<std::string> headingsOf(const std::string& printed);

// Every test file must have a first line with its purpose. Returns the problem, or an empty string.
std::string purposeProblem(const std::vector<std::string>& lines);

}  // namespace rung::tests
