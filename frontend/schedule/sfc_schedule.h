// SPDX-License-Identifier: Apache-2.0
// The scheduler of Sequential Function Charts: a chart becomes declarations and statements with locations in the chart.
// Conditions and times are copied, so that what was written stays as it is. In: steps, transitions and associations of
// a POU. Out: sections and statements. Called by sema: declareSfc when it collects the POU, scheduleSfc when it is
// about to check the body and knows which actions are variables. The behaviour of qualifiers is in the library
// (stdlib/iecsfc/sfc.st), not here.
//
// The state. Each step is an SFCStepType of its name, each action an SFCActionControl of its name with the prefix `_`,
// each named condition a BOOL. Sets of 64 steps per LWORD hold the active steps (sfc_steps), those left and those
// entered by the transitions of the last cycle (sfc_left, sfc_entered): a cycle visits set bits only. Sets of actions
// hold the control blocks with work to do (sfc_actions).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/signatures.h"
#include "frontend/syntax/tree.h"

namespace rung::text {

struct Charts {
  Tree& tree;
  Names& names;
  const Sources& sources;
  Diagnostics& diagnostics;
  const LanguageProfile& profile;
};

// The context of a chart.
struct ChartContext {
  bool final_scan = true;  // actions run once more when they end
  // Of a chart in an action or method: the charts of actions around it, then the block; else empty.
  std::vector<const PouDecl*> around;
};

// The sections of the chart's variables (SectionMaker::Chart); of a POU without a chart those of its conditions, which
// charts of its actions use.
Slice<DeclId> declareSfc(const Charts& charts, const PouDecl& pou, const ChartContext& context);
// The name of a variable with which a chart is controlled, such as SFCInit.
bool isSfcFlag(std::string_view name);
// The statements of a cycle. None: the chart has errors, which were reported.
std::optional<Slice<StmtId>> scheduleSfc(const Charts& charts, Signatures& signatures, const PouDecl& pou,
                                         const ChartContext& context);
// The rules for charts as a whole (sfc_check.cpp).
struct ChartCheck {
  bool ok;       // false: errors were reported
  bool crossed;  // a path enters or leaves a parallel branch, so a step may be entered while it is active
};
ChartCheck checkSfc(const Charts& charts, Signatures& signatures, const PouDecl& pou, const ChartContext& context);

// Looks up the steps of a chart by name.
class StepIndex {
 public:
  StepIndex(const Charts& charts, const PouDecl& pou);
  // The first step of this name, or the number of steps.
  uint32_t of(NameId name) const;

 private:
  const Names& names_;
  std::vector<std::pair<uint32_t, uint32_t>> by_name_;  // name key and step, sorted
  uint32_t count_;
};

}  // namespace rung::text
