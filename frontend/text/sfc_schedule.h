// The scheduler of Sequential Function Charts: a chart becomes declarations and statements, as text in ST whose parts
// lead back to the chart's own places. In: steps, transitions and associations of a POU. Out: sections and statements
// in its PouDecl, the text of both for `rung convert`. Called by sema: the sections when it collects the POU, the
// statements when the body is about to be checked.
//
// The state. Each step is an SFCStepType of its name, each action an SFCActionControl of its name behind `_`, each
// named condition a BOOL. Words of 64 steps say which are active (sfc_steps), which were left and which entered by the
// transitions of the last cycle (sfc_left, sfc_entered): a cycle visits set bits only. Words of 64 actions say whose
// control blocks have something to do (sfc_actions).
#pragma once

#include <utility>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/signatures.h"
#include "frontend/syntax/tree.h"
#include "frontend/text/parse.h"

namespace rung::text {

struct Charts {
  Tree& tree;
  Names& names;
  Sources& sources;
  Diagnostics& diagnostics;
  Dialect dialect;
};

// Where a chart stands.
struct ChartContext {
  bool final_scan = true;  // actions run once more when they end
  // Of a chart in an action or method: the charts of actions around it, then the block; else empty.
  std::vector<const PouDecl*> around;
};

// Appends the sections of the chart's variables to those of the POU. Of a POU without a chart those of its conditions,
// which charts of its actions use.
void declareSfc(const Charts& charts, PouDecl& pou, const ChartContext& context);
// Fills the POU's statements. False: the chart is wrong, which was reported.
bool scheduleSfc(const Charts& charts, Signatures& signatures, PouDecl& pou, const ChartContext& context);
// The rules for charts as a whole (sfc_check.cpp).
bool checkSfc(const Charts& charts, Signatures& signatures, const PouDecl& pou, const ChartContext& context);

// The steps of a chart by name.
class StepIndex {
 public:
  StepIndex(const Charts& charts, const PouDecl& pou);
  // The first step of this name, or as many as there are.
  uint32_t of(NameId name) const;

 private:
  const Names& names_;
  std::vector<std::pair<uint32_t, uint32_t>> by_name_;  // name key and step, sorted
  uint32_t count_;
};

}  // namespace rung::text
