// SPDX-License-Identifier: Apache-2.0
// Runs an exported file with Rung itself: the exporter writes nothing that it has not tried in the plain form. In:
// a file on disk and a dialect. Out: errors, or a trace. Every trial is a compilation of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frontend/source/dialect.h"

namespace rung::conformance {

struct Complaint {
  std::string code, message;
  uint32_t line;
  friend bool operator==(const Complaint&, const Complaint&) = default;
};

struct Checked {
  std::vector<Complaint> errors;                                  // none: accepted
  std::vector<std::pair<std::string, std::string>> library_pous;  // name and library of those that the text names
  bool refused = false;                                           // it cannot be read
  std::vector<uint32_t> conversions;                              // lines with an implicit conversion of numbers
};
Checked check(const std::string& file, Dialect dialect);

struct RunSetting {
  int64_t cycles = 1, interval_ns = 10'000'000;
  std::vector<std::string> watch;
  std::vector<std::string> options;  // further ones of `rung run`
};
struct Ran {
  int exit = 0;
  std::string messages;
  std::vector<std::string> trace;  // lines of CSV
};
Ran run(const std::string& file, Dialect dialect, const RunSetting& setting);

// The text of a file that is not ST as the ST that Rung reads from it. Empty: it has errors.
std::string asSt(const std::string& file);
// The project of one file as PLCopen XML, printed like `rung convert --to xml`. Empty: refused.
std::string asXml(const std::string& file, const std::string& scratch);

}  // namespace rung::conformance
