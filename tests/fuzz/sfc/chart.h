// SPDX-License-Identifier: Apache-2.0
// A generated chart, its source, and its behaviour according to a simple evaluator, independent of the compiler: it
// visits all steps, transitions and actions in each cycle (syntax manual 5.9.8; IEC 61131-3 ed. 3 tables 59 and 60).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rung::sfc_differential {

enum Qualifier { kN, kR, kS, kL, kD, kP, kP0, kP1, kSD, kDS, kSL, kQualifiers };
struct Association {
  int action, qualifier;
};
struct Step {
  std::vector<Association> associations;
  int entry = -1, active = -1, exit = -1;  // actions
  int least_ms = 0;
};
struct Transition {
  std::vector<int> from, to;
  uint32_t modulus, value;  // fires when random / 65536 MOD modulus = value
  int priority = 0;         // 0: none
};
constexpr int kVariables = 6, kActions = 12;  // the first are BOOL variables
struct Macro {                                // the steps from `begin` to before `end`, and the elements inside
  int begin, end, entry, exit;
};
struct Chart {
  std::vector<Step> steps;  // the first is the initial one
  std::vector<Macro> macros;
  std::vector<Chart> nested;  // none, or the body of the last action
  std::vector<Transition> transitions;
  int times_ms[kActions];  // of all associations of an action
  bool final_scan = true;
};

Chart generate(uint64_t seed);
std::string textOf(const Chart& chart, const std::string& name);
// The path of a step of the nested chart in the trace: its bare name when no other step of the block has it.
std::string nestedStep(const Chart& chart, size_t step);

// The chart without features that PLCopen XML cannot express: minimum times and numbered priorities.
Chart withoutTextForms(Chart chart);
// The chart as a <pou>, drawn in one of many ways.
std::string xmlOf(const Chart& chart, const std::string& name, uint64_t seed);

// The observable state after a cycle.
struct Seen {
  std::vector<bool> active;  // steps
  bool variables[kVariables];
  uint32_t order;  // of the actions that ran, as a checksum
  std::vector<bool> nested_active;
  std::vector<bool> nested_variables;
};
std::vector<Seen> evaluate(const Chart& chart, const std::vector<uint32_t>& randoms, int cycle_ms);

}  // namespace rung::sfc_differential
