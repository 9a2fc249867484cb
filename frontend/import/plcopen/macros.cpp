// SPDX-License-Identifier: Apache-2.0
// Macro steps of a chart: a <macroStep> becomes a MACRO_STEP, which the parser inlines; see chart.h.
#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/chart.h"

namespace rung::importer::plcopen {

// Forbids a macro step that has not exactly one step without predecessor (the entry) and one without successor (the
// exit). An end that no wire needs may be missing. TC6 2.01, macroStep; TM/TP manual 5.5.2.5.
//   fails   <macroStep name="M"> after a transition, with <body><SFC/></body>          E1068
void Chart::findEnd(Macro& macro, bool entry) {
  const ChartNode& node = nodes_[macro.node];
  bool needed = entry && node.first_wire != node.end_wire;
  for (const uint32_t next : after_[macro.node]) needed |= !entry && nodes_[next].kind != NodeKind::Other;
  if (!needed) return;
  const Chart& chart = *macro.chart;
  uint32_t& end = entry ? macro.entry : macro.exit;
  uint32_t found = 0;
  for (uint32_t i = 0; i < chart.nodes_.size(); ++i) {
    const ChartNode& n = chart.nodes_[i];
    if (n.kind != NodeKind::Step && n.kind != NodeKind::MacroStep) continue;
    bool is_end = !entry || n.first_wire == n.end_wire;
    for (const uint32_t next : chart.after_[i])
      is_end &= entry || chart.nodes_[next].kind == NodeKind::Other || chart.nodes_[next].kind == NodeKind::ActionBlock;
    if (!is_end) continue;
    ++found;
    end = i;
  }
  if (found != 1)
    report(diag::ChartMacroEnds, node.element->loc,
           {document_.value(*node.element, "name"),
            entry ? "without a predecessor, as its entry" : "without a successor, as its exit"});
}

void Chart::connectMacro(uint32_t node) {
  const xml::Element* body = document_.child(*nodes_[node].element, "body");
  const xml::Element* inner = body == nullptr ? nullptr : document_.child(*body, "SFC");
  if (inner == nullptr) inner = nodes_[node].element;  // which contains no steps
  Macro& macro = macros_.emplace_back();
  macro.node = node;
  macro.chart.reset(new Chart(*this, *inner, node));
  macro.chart->connect();
  ok_ &= macro.chart->ok_;
  for (const bool entry : {true, false})
    if (ok_) findEnd(macro, entry);
}

// MACRO_STEP name (ENTRY := a, EXIT := b): elements END_MACRO_STEP
void Chart::writeMacro(const Macro& macro) {
  const xml::Element& element = *nodes_[macro.node].element;
  import_.out.put(element.loc, "MACRO_STEP ");
  import_.out.add(stepName(macro.node));
  const char* before = " (";
  for (const auto& [word, end] : {std::pair{"ENTRY := ", macro.entry}, std::pair{"EXIT := ", macro.exit}}) {
    if (end == UINT32_MAX) continue;
    import_.out.word(before + std::string(word));
    import_.out.add(macro.chart->stepName(end));
    before = ", ";
  }
  import_.out.word(before[0] == ',' ? "):\n" : ":\n");
  macro.chart->writeElements();
  ok_ &= macro.chart->ok_;
  import_.out.put(element.end, "END_MACRO_STEP\n");
}

}  // namespace rung::importer::plcopen
