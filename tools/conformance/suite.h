// SPDX-License-Identifier: Apache-2.0
// The exported suite: cases with their files, the rows of the standard's tables that they prove, and why others are not
// exported. In: the programs of a project. Out: a folder with a manifest that nothing of Rung is needed to read.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "frontend/source/dialect.h"
#include "tools/conformance/neutral.h"
#include "tools/conformance/program.h"
#include "tools/conformance/trial.h"

namespace rung::conformance {

// A set of cases for compilers of one kind.
struct Profile {
  const char* name;
  Dialect dialect;
  int edition;
};
extern const Profile kProfiles[5];  // ed2-text, ed3-text, ed3-oop, plcopen-xml, motion
const Profile* findProfile(std::string_view name);

struct Case {
  std::string id;  // also the path of its files, without their endings
  const Profile* profile;
  std::string program, test, purpose;
  std::vector<std::string> features;
  std::string source;  // the file
  // of a run
  std::vector<std::string> watch, checks;
  std::vector<std::string> trace;  // CSV
  int64_t restart_after = 0;       // cycles before a warm start, after which the trace begins; 0: no restart
  int64_t cycles = 0, interval_ns = 10'000'000;
  std::string inputs;  // CSV
  // of an error that is due
  uint32_t line = 0;
  std::string code;     // Rung's
  std::string rule;     // of the standard
  std::string control;  // the same source without the error
  // what it needs
  std::vector<std::string> types, blocks, languages;

  bool isRun() const { return line == 0; }
};

struct Feature {
  std::string id, editions, name, table;
};

// Why a program, or one test of it, is in no profile.
struct Refusal {
  std::string program, test, reason;
  std::vector<std::string> features;
};

struct Suite {
  std::vector<Feature> features;
  std::vector<Case> cases;
  std::vector<Refusal> refusals;
  std::map<std::string, std::string> reasons;  // by feature: why nothing proves it outside of Rung

  std::set<std::string> exported() const;  // features
};

// tests/conformance/features.tsv, tools/conformance/reasons.tsv. The error names what could not be read.
[[nodiscard]] std::string readTables(const std::string& root, Suite& suite);

std::string manifest(const Suite& suite, const std::vector<const Profile*>& profiles);
// rows.tsv: each row of edition 3 with its cases, or the reason why it has none.
std::string rowTable(const Suite& suite);
// refusals.tsv: each program, or test of it, that is in no profile, and why.
std::string refusalTable(const Suite& suite);

}  // namespace rung::conformance
