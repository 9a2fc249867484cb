// SPDX-License-Identifier: Apache-2.0
// Macro steps of a chart: a named part of it. The notation is specific to Rung, since the standard has none for text.
//   macro = MACRO_STEP name ["(" (ENTRY | EXIT) ":=" step {"," …} ")"] ":" {step | transition | macro} END_MACRO_STEP
// The parser inlines the part: a transition to the macro activates its entry, one from it leaves its exit; by default
// these are its first and its last step in the source. TM/TP manual 5.5.2.5.
#include <unordered_map>

#include "frontend/parse/chart.h"
#include "frontend/parse/diagnostics.h"
#include "frontend/syntax/diagnostics.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

constexpr size_t kMaxMacroDepth = 200;

void ChartParser::skipMacro() {
  uint32_t open = 0;
  do {
    if (is(t_, "MACRO_STEP")) ++open;
    if (atMacroEnd()) --open;
    advance();
  } while (open > 0 && !at(Tok::End));
}

void ChartParser::openMacro(std::vector<SfcMacro>& macros, std::vector<uint32_t>& open, size_t steps) {
  if (open.size() == kMaxMacroDepth) {
    tooDeep("macro steps", kMaxMacroDepth);
    return skipMacro();
  }
  SfcMacro macro{};
  macro.open = t_;
  macro.errors = diagnostics_.errorCount();
  macro.first_step = macro.end_step = static_cast<uint32_t>(steps);
  advance();
  if (parseName(macro.name) && at(Tok::LeftParen)) {
    advance();
    do {
      const bool entry = is(t_, "ENTRY");
      if (!entry && !is(t_, "EXIT")) {
        fail(diag::WrongKeyword, t_, {textOf(t_), "ENTRY` or `EXIT"});
        break;
      }
      advance();
      expect(Tok::Assign);
      parseName(entry ? macro.entry : macro.exit);
    } while (!panic_ && accept(Tok::Comma));
    if (!panic_) expect(Tok::RightParen);
  }
  if (!panic_) expect(Tok::Colon);
  if (panic_) syncChart(Tok::EndStep);
  open.push_back(static_cast<uint32_t>(macros.size()));
  macros.push_back(macro);
}

// Forbids a macro step without steps, and an ENTRY or EXIT that is not a step inside it.
//   passes  MACRO_STEP Heat: STEP a: END_STEP END_MACRO_STEP
//   fails   MACRO_STEP Heat: END_MACRO_STEP                                            E0744
//   fails   MACRO_STEP Heat (ENTRY := b): STEP a: END_STEP END_MACRO_STEP              E0745
void ChartParser::closeMacro(std::vector<SfcMacro>& macros, std::vector<uint32_t>& open,
                             std::span<const SfcStep> steps) {
  SfcMacro& macro = macros[open.back()];
  const uint32_t first_inner = open.back() + 1;
  open.pop_back();
  macro.end_step = static_cast<uint32_t>(steps.size());
  if (macro.first_step == macro.end_step) {
    if (macro.name.name && diagnostics_.errorCount() == macro.errors)
      diagnostics_.report(diag::MacroEmpty, macro.name.loc, {names_.string(macro.name.name)});
    return;
  }
  // An inner macro has its own entry and exit; of two that begin together the outer one comes first.
  const auto inner = [&](NameId name) -> const SfcMacro* {
    for (uint32_t i = first_inner; i < macros.size(); ++i)
      if (names_.same(macros[i].name.name, name)) return &macros[i];
    return nullptr;
  };
  for (Ident* end : {&macro.entry, &macro.exit}) {
    if (!end->name) continue;
    bool found = inner(end->name) != nullptr;
    for (uint32_t i = macro.first_step; i < macro.end_step; ++i) found |= names_.same(steps[i].name.name, end->name);
    if (found) continue;
    std::vector<std::string_view> candidates;
    for (const SfcStep& step : steps.subspan(macro.first_step)) candidates.push_back(names_.string(step.name.name));
    diagnostics_.report(diag::MacroStepUnknown, end->loc, {names_.string(end->name), names_.string(macro.name.name)})
        .didYouMean(nearest(names_.string(end->name), candidates));
    *end = {};
  }
  if (!macro.entry.name) {
    macro.entry = steps[macro.first_step].name;
    for (uint32_t i = static_cast<uint32_t>(macros.size()); i-- > first_inner;)
      if (macros[i].first_step == macro.first_step) macro.entry = macros[i].entry;
  }
  if (!macro.exit.name) {
    macro.exit = steps.back().name;
    for (uint32_t i = static_cast<uint32_t>(macros.size()); i-- > first_inner;)
      if (macros[i].end_step == macro.end_step) macro.exit = macros[i].exit;
  }
}

// Forbids a macro step with the name of a step or of another macro: transitions to it would be ambiguous.
void ChartParser::inlineMacros(std::span<const SfcMacro> macros, std::span<const SfcStep> steps,
                               std::vector<SfcTransition>& transitions) {
  if (macros.empty()) return;
  std::unordered_map<uint32_t, const SfcMacro*> by_name;
  const auto find = [&](NameId name) -> const SfcMacro* {
    const auto found = by_name.find(names_.key(name).index);
    return found == by_name.end() ? nullptr : found->second;
  };
  const auto reportTwice = [&](const Ident& name, Loc first) {
    diagnostics_.report(diag::DuplicateDeclaration, name.loc, {names_.string(name.name)}).alsoDeclaredHere(first);
  };
  for (const SfcMacro& macro : macros) {
    if (const SfcMacro* first = find(macro.name.name)) return reportTwice(macro.name, first->name.loc);
    by_name[names_.key(macro.name.name).index] = &macro;
  }
  for (const SfcStep& step : steps)
    if (const SfcMacro* macro = find(step.name.name)) return reportTwice(macro->name, step.name.loc);
  // An entry may be an inner macro, whose entry may be one again.
  const auto resolve = [&](Slice<Ident>& list, bool entry) {
    std::vector<Ident> created(tree_.list(list).begin(), tree_.list(list).end());
    bool changed = false;
    for (Ident& step : created) {
      while (const SfcMacro* macro = find(step.name)) {
        step.name = (entry ? macro->entry : macro->exit).name;
        changed = true;
      }
    }
    if (changed) list = tree_.addList<Ident>(created);
  };
  for (SfcTransition& t : transitions) {
    resolve(t.from, false);
    resolve(t.to, true);
  }
}

}  // namespace rung::text
