// SPDX-License-Identifier: Apache-2.0
// Writes charts as textual SFC (docs/language.md, frontend/parse/sfc.cpp), as source-mapped text. In: steps and
// transitions, described as a reader finds them in its file. Called by the readers of SFC, which resolve wires and
// branches.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/import/network_writer.h"
#include "frontend/import/source_mapped_text.h"

namespace rung::importer {

struct StepAction {
  std::string_view pragma;  // entry, active, exit: `{entry} a;`; empty: an association, `a(L, T#5s, done);`
  xml::Excerpt name;
  xml::Excerpt qualifier;        // empty: N
  std::string_view time_prefix;  // T# where the file leaves it out
  xml::Excerpt time;
  std::vector<xml::Excerpt> indicators;
};

struct ChartStep {
  Loc loc, end;
  bool initial = false;
  xml::Excerpt name;
  Area area;
  xml::Excerpt minimum, maximum;  // TMIN, TMAX
  std::vector<StepAction> actions;
};

struct ChartTransition {
  Loc loc;
  xml::Excerpt name;
  Area area;
  xml::Excerpt priority;
  std::vector<xml::Excerpt> from, to;  // steps
};

class ChartWriter {
 public:
  explicit ChartWriter(xml::SourceMappedText& out) : out_(out) {}

  void write(const ChartStep& step);
  // `TRANSITION FROM a TO b`: its condition or body, written by the caller, follows.
  void beginTransition(const ChartTransition& transition);
  void endTransition(Loc end) { out_.put(end, " END_TRANSITION\n"); }

 private:
  void write(const StepAction& action);
  void writeSteps(const std::vector<xml::Excerpt>& steps);

  xml::SourceMappedText& out_;
};

// Appended to an action with the name of a step: in ST, members of a block share one name space.
constexpr std::string_view kActionSuffix = "_action";

// The variables that the settings of a chart enable by the name of a flag, `Init`, `CurrentStep`: a section with the
// declaration. Empty: not such a flag. The chart uses the variables only if they are declared.
std::string declarationOfFlag(std::string_view flag);

}  // namespace rung::importer
