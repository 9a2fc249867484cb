// SPDX-License-Identifier: Apache-2.0
#include "sema/declarations/charts.h"
#include "sema/declarations/collect.h"
#include "sema/project.h"
#include "sema/scopes.h"

namespace rung::sema {

text::Charts chartsOf(const Context& context) {
  const Symbols& symbols = context.symbols;
  return {symbols.arena, symbols.names, symbols.sources, symbols.diagnostics, context.profile()};
}

text::ChartContext chartContextOf(const Context& context, PouId pou) {
  text::ChartContext chart;
  chart.final_scan = context.profile().final_scan;
  for (PouId at = pou; at;) {
    const Pou& of = context.symbols.pou(at);
    const PouDecl& decl = context.tree().as<PouDecl>(of.decl);
    if (at != pou) chart.around.push_back(&decl);
    if (findPragma(context, decl.h, context.scopes.known_names.no_final_scan) != nullptr) chart.final_scan = false;
    at = of.chart ? of.chart : of.owner;
  }
  return chart;
}

void declareChart(Context& context, PouId id) {
  const PouDecl& decl = context.tree().as<PouDecl>(context.symbols.pou(id).decl);
  const Slice<DeclId> made = text::declareSfc(chartsOf(context), decl, chartContextOf(context, id));
  const std::span<const DeclId> sections = context.tree().list(made);
  context.project.made_sections[&decl].assign(sections.begin(), sections.end());
}

}  // namespace rung::sema
