// SPDX-License-Identifier: Apache-2.0
// The variables of a chart; see sfc_schedule.h. Those of a chart in an action are VAR_INST, so that it keeps its state.
// Flags from other declarations are not known yet: the variables they need are declared where their name occurs
// anywhere in the project.
#include "frontend/schedule/sfc_chart.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {
namespace {

void writeSections(const Chart& chart, Writer& out) {
  const auto set = [&](const char* name, size_t count, std::string_view initial) {
    const uint32_t words = chart.words(count);
    if (words <= 1)
      out.line(1, name, " : LWORD", initial.empty() ? "" : " := ", initial, ";");
    else
      out.line(1, name, " : ARRAY[0..", std::to_string(words - 1), "] OF LWORD", initial.empty() ? "" : " := [",
               initial, initial.empty() ? ";" : "];");
  };
  out.line(0, chart.context_.around.empty() ? "VAR" : "VAR_INST");
  for (uint32_t i = 0; i < chart.steps_.size(); ++i) {
    const SfcStep& step = chart.steps_[i];
    out.at(step.name.loc);
    out.line(1, step.name, " : SFCStepType;");
  }
  for (uint32_t i = 0; i < chart.actions_.size(); ++i) {
    out.at(chart.actions_[i].loc);
    out.line(1, chart.controlOf(i), " : SFCActionControl",
             chart.context_.final_scan ? ";" : " := (final_scan := FALSE);");
  }
  for (size_t i = 0; i < chart.transitions_.size(); ++i) {
    const SfcTransition& t = chart.transitions_[i];
    if (!chart.keepsCondition(t)) continue;
    out.at(t.target.loc);
    out.line(1, t.target, " : BOOL;");
  }
  if (chart.pou_.body_kind != BodyKind::Sfc) return out.line(0, "END_VAR");
  out.at(chart.pou_.body_begin);
  set("sfc_steps", chart.steps_.size(), "");
  set("sfc_left", chart.steps_.size(), "");
  set("sfc_entered", chart.steps_.size(), chart.initialSteps());
  if (!chart.actions_.empty()) set("sfc_actions", chart.actions_.size(), "");
  out.line(1, "sfc_fired : BOOL := TRUE;");
  if (chart.charts_.names.find("SFCTipMode")) out.line(1, "sfc_tip, sfc_tip_before : BOOL;");
  if (chart.charts_.names.find("SFCPause") || chart.charts_.names.find("SFCQuitError"))
    out.line(1, "sfc_paused, sfc_last : TIME;");
  out.line(0, "END_VAR");
  out.line(0, "VAR_TEMP");
  out.line(1, "sfc_now : TIME;");
  out.line(1, "sfc_set : LWORD;");
  if (chart.charts_.names.find("SFCErrorAnalyzationTable")) out.line(1, "sfc_row : DINT;");
  if (chart.words(chart.steps_.size()) > 1 || chart.words(chart.actions_.size()) > 1) out.line(1, "sfc_word : INT;");
  out.line(0, "END_VAR");
}

}  // namespace

ChartSections declareSfc(const Charts& charts, const PouDecl& pou, const ChartContext& context) {
  const Chart chart(charts, pou, context);
  Writer out(charts, pou.body_begin);
  writeSections(chart, out);
  const FileId text = out.finish();
  return {parseSections(charts.tree, charts.names, charts.sources, text, charts.profile.dialect, charts.diagnostics),
          text};
}

}  // namespace rung::text
