// SPDX-License-Identifier: Apache-2.0
#include "frontend/import/chart_writer.h"

namespace rung::importer {

// STEP name (TMIN := t, TMAX := u): {entry} a; {active} b; {exit} c; d(N); END_STEP
void ChartWriter::write(const ChartStep& step) {
  out_.put(step.loc, step.initial ? "INITIAL_STEP " : "STEP ");
  out_.add(step.name);
  out_.word(clauseOf(step.area));
  if (!step.minimum.empty()) {
    out_.word(" (TMIN := ");
    out_.add(step.minimum);
  }
  if (!step.maximum.empty()) {
    out_.word(step.minimum.empty() ? " (TMAX := " : ", TMAX := ");
    out_.add(step.maximum);
  }
  out_.word(step.minimum.empty() && step.maximum.empty() ? ":\n" : "):\n");
  for (const StepAction& action : step.actions) write(action);
  out_.put(step.end, "END_STEP\n");
}

void ChartWriter::write(const StepAction& action) {
  if (!action.pragma.empty()) out_.put(action.name.begin(), "{" + std::string(action.pragma) + "} ");
  out_.add(action.name);
  if (!action.pragma.empty()) return out_.word(";\n");
  out_.word("(");
  if (action.qualifier.empty())
    out_.word("N");
  else
    out_.add(action.qualifier);
  if (!action.time.empty()) {
    out_.word(", " + std::string(action.time_prefix));
    out_.add(action.time);
  }
  for (const xml::Excerpt& indicator : action.indicators) {
    out_.word(", ");
    out_.add(indicator);
  }
  out_.word(");\n");
}

void ChartWriter::beginTransition(const ChartTransition& transition) {
  out_.put(transition.loc, "TRANSITION ");
  if (!transition.name.empty()) {
    out_.add(transition.name);
    out_.word(" ");
  }
  if (const std::string area = clauseOf(transition.area); !area.empty()) out_.put(transition.loc, area.substr(1) + " ");
  if (!transition.priority.empty()) {
    out_.word("(PRIORITY := ");
    out_.add(transition.priority);
    out_.word(") ");
  }
  out_.put(transition.loc, "FROM ");
  writeSteps(transition.from);
  out_.put(transition.loc, " TO ");
  writeSteps(transition.to);
}

// a or (a, b)
void ChartWriter::writeSteps(const std::vector<xml::Excerpt>& steps) {
  if (steps.size() > 1) out_.word("(");
  for (size_t i = 0; i < steps.size(); ++i) {
    if (i > 0) out_.word(", ");
    out_.add(steps[i]);
  }
  if (steps.size() > 1) out_.word(")");
}

std::string declarationOfFlag(std::string_view flag) {
  struct Row {
    std::string_view flag, section, type;
  };
  static constexpr Row kFlags[] = {{"Init", "VAR_INPUT", "BOOL"},
                                   {"Reset", "VAR_INPUT", "BOOL"},
                                   {"QuitError", "VAR_INPUT", "BOOL"},
                                   {"Pause", "VAR_INPUT", "BOOL"},
                                   {"Tip", "VAR_INPUT", "BOOL"},
                                   {"TipMode", "VAR_INPUT", "BOOL"},
                                   {"EnableLimit", "VAR_INPUT", "BOOL"},
                                   {"Error", "VAR_OUTPUT", "BOOL"},
                                   {"Trans", "VAR_OUTPUT", "BOOL"},
                                   {"ErrorStep", "VAR_OUTPUT", "STRING"},
                                   {"ErrorPOU", "VAR_OUTPUT", "STRING"},
                                   {"CurrentStep", "VAR_OUTPUT", "STRING"},
                                   {"ErrorAnalyzation", "VAR_OUTPUT", "STRING"}};
  for (const Row& row : kFlags)
    if (flag == row.flag)
      return std::string(row.section) + " SFC" + std::string(flag) + " : " + std::string(row.type) + "; END_VAR\n";
  return {};
}

}  // namespace rung::importer
