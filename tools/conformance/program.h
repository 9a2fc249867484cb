// SPDX-License-Identifier: Apache-2.0
// A program of tests/conformance or tests/programs as its author wrote it: its text and the lines of its head. In: a
// file. Out: Program. Read by the exporter, which turns it into neutral cases.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/dialect.h"

namespace rung::conformance {

// `// expect: name.st:4:1: error[E0231]: …`
struct Expectation {
  std::string code;
  uint32_t line;
};

struct Program {
  std::string path;  // relative to the root of the project
  std::string text;
  std::string purpose;
  std::vector<std::string> features;
  std::vector<std::string> catalogues;  // of `// covers:`, each once
  std::vector<std::string> arguments;   // `// args:`, `// run:`
  std::vector<std::string> others;      // `// with:`
  std::vector<Expectation> errors;      // of severity error
  bool expects = false;                 // has lines `// expect:`
  std::vector<std::string> trace;       // `// trace:`
  Dialect dialect = Dialect::Codesys;
  int64_t restart = 0;            // `// restart:`: cycles before a warm start, after which the trace begins
  bool faults = false;            // `// exit:`
  std::set<std::string> choices;  // `test:condition` of kept.tsv: assertions about what the standard leaves open
};

// An empty text: the file cannot be read.
Program readProgram(const std::string& root, const std::string& path);

// All files below the folder with one of the endings, sorted, relative to the root.
std::vector<std::string> filesBelow(const std::string& root, const std::string& folder,
                                    const std::vector<std::string>& endings);

std::vector<std::string> wordsOf(std::string_view line);
std::vector<std::string> linesOf(std::string_view text);
std::string joined(const std::vector<std::string>& words, std::string_view separator);

}  // namespace rung::conformance
