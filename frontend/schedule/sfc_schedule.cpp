// SPDX-License-Identifier: Apache-2.0
// Writes a chart as declarations and statements; see sfc_schedule.h. The statements of a cycle, in this order (TM/TP
// manual 5.5; syntax manual 5.9.8):
//   1. flags: SFCInit, SFCReset, SFCQuitError, SFCPause
//   2. exit actions of steps that were left, entry actions of steps that were entered
//   3. active steps: times, limits, active actions, qualifiers of their actions
//   4. control blocks, boolean variables and final scans; then the actions that are active; both by name in codesys
//      ("Processing Order in SFC" of the CODESYS and TwinCAT help), else in the order of their first association
//   5. transitions of active steps: the first that fires, by priority, then in source order
#include "frontend/schedule/sfc_schedule.h"

#include <algorithm>

#include "frontend/schedule/sfc_scheduler.h"
#include "frontend/syntax/children.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

void SfcScheduler::forWords(uint32_t depth, size_t count,
                            FunctionRef<void(const std::string& index, uint32_t depth)> body) {
  const uint32_t words = chart_.words(count);
  if (words <= 1) return body("", depth);
  out_.line(depth, "FOR sfc_word := 0 TO ", std::to_string(words - 1), " DO");
  body("[sfc_word]", depth + 1);
  out_.line(depth, "END_FOR");
}

void SfcScheduler::scan(uint32_t depth, const char* set, size_t count, FunctionRef<bool(uint32_t)> wanted,
                        FunctionRef<std::string_view(uint32_t)> name, Branch branch) {
  uint32_t first = 0;
  while (first < count && !wanted(first)) ++first;
  if (first == count) return;
  out_.at(chart_.pou_.body_begin);
  forWords(depth, count, [&](const std::string& index, uint32_t inner) {
    out_.line(inner, "sfc_set := ", set, index, ";");
    out_.line(inner, "WHILE sfc_set <> LWORD#0 DO");
    out_.line(inner + 1, "CASE ", index.empty() ? "" : "sfc_word * 64 + ", "SFCTakeBit(sfc_set) OF");
    for (uint32_t i = first; i < count; ++i) {
      if (!wanted(i)) continue;
      out_.line(inner + 2, std::to_string(i), ":  // ", name(i));
      branch(i, inner + 3);
    }
    out_.at(chart_.pou_.body_begin);
    out_.line(inner + 1, "END_CASE");
    out_.line(inner, "END_WHILE");
  });
}

// The entry, active or exit actions of a step.
void SfcScheduler::run(uint32_t depth, const SfcStep& step, SfcQualifier when) {
  for (const SfcAssociation& a : tree_.list(step.actions)) {
    if (a.qualifier != when) continue;
    out_.at(a.action.loc);
    out_.line(depth, a.action, callsAction(a.action) ? "();" : " := TRUE;");
  }
}

// Applies the transitions that fired in the last cycle.
void SfcScheduler::evolve() {
  const size_t count = chart_.steps_.size();
  const auto all = [](uint32_t) { return true; };
  out_.at(chart_.pou_.body_begin);
  out_.line(0, "IF sfc_fired THEN");
  out_.line(1, "sfc_fired := FALSE;");
  scan(1, "sfc_left", count, all, stepNames(), [&](uint32_t i, uint32_t depth) {
    const SfcStep& step = chart_.steps_[i];
    out_.at(step.name.loc);
    out_.line(depth, step.name, ".x := FALSE;");
    run(depth, step, SfcQualifier::Exit);
  });
  scan(1, "sfc_entered", count, all, stepNames(), [&](uint32_t i, uint32_t depth) {
    const SfcStep& step = chart_.steps_[i];
    out_.at(step.name.loc);
    if (crossed_) out_.line(depth++, "IF NOT ", step.name, ".x THEN");  // it may be active: another branch is in it
    out_.line(depth, step.name, ".x := TRUE;");
    out_.line(depth, step.name, "._x := TRUE;");
    out_.line(depth, step.name, "._t := sfc_now;");
    out_.line(depth, step.name, ".t := T#0s;");
    run(depth, step, SfcQualifier::Entry);
    if (crossed_) out_.line(--depth, "END_IF");
  });
  forWords(1, count, [&](const std::string& index, uint32_t depth) {
    out_.line(depth, "sfc_steps", index, " := sfc_steps", index, " AND NOT sfc_left", index, " OR sfc_entered", index,
              ";");
    out_.line(depth, "sfc_left", index, " := LWORD#0;");
    out_.line(depth, "sfc_entered", index, " := LWORD#0;");
  });
  out_.line(0, "END_IF");
}

void SfcScheduler::activeStep(uint32_t i, uint32_t depth) {
  const SfcStep& step = chart_.steps_[i];
  out_.at(step.name.loc);
  out_.line(depth, step.name, ".t := sfc_now - ", step.name, "._t;");
  timeLimit(step, depth);
  out_.at(step.name.loc);
  if (const Ident* flag = chart_.flag(SfcFlag::CurrentStep)) out_.line(depth, *flag, " := '", step.name, "';");
  run(depth, step, SfcQualifier::Active);
  for (const SfcAssociation& a : tree_.list(step.actions)) {
    if (!isControlled(a.qualifier)) continue;
    out_.at(a.loc);
    const uint32_t action = chart_.actionOf(a.action.name);
    const std::string& control = chart_.controlOf(action);
    out_.line(depth, control, ".", keywordOf(a.qualifier), " := TRUE;");
    if (a.time.value) {
      out_.line(depth, control, ".T := ", a.time, ";");
      out_.at(a.loc);
    }
    const std::string set = word("sfc_actions", chart_.actions_.size(), action);
    out_.line(depth, set, " := ", set, " OR ", maskOf(action), ";");
  }
}

void SfcScheduler::actions() {
  const size_t count = chart_.actions_.size();
  scan(
      0, "sfc_actions", count, [](uint32_t) { return true; }, actionNames(),
      [&](uint32_t i, uint32_t depth) {
        const Ident& action = chart_.actions_[i];
        const std::string set = word("sfc_actions", count, i);
        out_.at(action.loc);
        const std::string& control = chart_.controlOf(i);
        out_.line(depth, control, "(now := sfc_now);");
        if (callsAction(action)) {
          out_.line(depth, "IF ", control, ".x AND NOT ", control, "._x THEN");
          out_.line(depth + 1, action, "();");
          out_.line(depth, "END_IF");
        } else {
          out_.line(depth, action, " := ", control, "._x;");
        }
        out_.line(depth, "IF NOT ", control, ".busy THEN");
        out_.line(depth + 1, set, " := ", set, " AND NOT ", maskOf(i), ";");
        out_.line(depth, "END_IF");
      });
  scan(
      0, "sfc_actions", count, [&](uint32_t i) { return callsAction(chart_.actions_[i]); }, actionNames(),
      [&](uint32_t i, uint32_t depth) {
        const Ident& action = chart_.actions_[i];
        out_.at(action.loc);
        out_.line(depth, "IF ", chart_.controlOf(i), "._x THEN");
        out_.line(depth + 1, action, "();");
        out_.line(depth, "END_IF");
      });
}

// `TRANSITION t FROM a TO b;` has the condition of `TRANSITION t := …`, of this or an enclosing chart, or is the
// variable t.
const SfcTransition& SfcScheduler::conditionOf(const SfcTransition& t) const {
  if (t.body || t.condition.value) return t;
  for (const SfcTransition& other : chart_.transitions_)
    if (other.body && charts_.names.same(other.name.name, t.name.name)) return other;
  for (const PouDecl* pou : chart_.context_.around)
    for (const SfcTransition& other : tree_.list(pou->transitions))
      if (other.body && charts_.names.same(other.name.name, t.name.name)) return other;
  return t;
}

void SfcScheduler::prepare(uint32_t way, uint32_t depth) {
  const SfcTransition& t = conditionOf(chart_.transitions_[way]);
  out_.at(t.loc);
  if (t.body)
    out_.line(depth, chart_.string(tree_.as<PouDecl>(t.body).name), "();");
  else if (chart_.keepsCondition(t))
    out_.line(depth, t.target, " := ", t.condition, ";");
}

void SfcScheduler::condition(uint32_t way) {
  const SfcTransition& own = chart_.transitions_[way];
  const SfcTransition& t = conditionOf(own);
  const std::span<const Ident> from = tree_.list(own.from);
  const bool tips = chart_.flag(SfcFlag::TipMode) != nullptr;
  out_.at(own.loc);
  std::string before;
  for (size_t i = 1; i < from.size(); ++i) {
    before +=
        std::string(chart_.string(from[i].name)) + ".x AND " + std::string(chart_.string(from[i].name)) + "._x AND ";
  }
  const bool quoted = t.condition.value && !chart_.keepsCondition(t);
  if (quoted && tree_.kind(t.condition.value) == ExprKind::Literal && before.empty() && !tips)
    before = std::string(chart_.string(from[0].name)) + ".x AND ";  // no IF on a constant
  out_.put(before);
  for (size_t i = 1; i < from.size(); ++i) {
    const SfcStep& step = chart_.steps_[chart_.index_.of(from[i].name)];
    if (!step.min.value) continue;
    out_.put(step.name);
    out_.put(".t >= ");
    out_.put(step.min);
    out_.put(" AND ");
  }
  if (tips) {
    out_.put("SEL(");
    out_.put(*chart_.flag(SfcFlag::TipMode));
    out_.put(", ");
  }
  if (!quoted) {
    out_.put(t.target.name ? t.target : t.name);
  } else {
    const bool parens = from.size() > 1 && !tips;
    if (parens) out_.put("(");
    out_.put(t.condition);
    if (parens) out_.put(")");
  }
  if (tips) out_.put(", sfc_tip)");
}

void SfcScheduler::fire(uint32_t way, uint32_t depth) {
  const SfcTransition& t = chart_.transitions_[way];
  out_.at(t.loc);
  for (const Ident& step : tree_.list(t.from)) {
    const uint32_t i = chart_.index_.of(step.name);
    out_.line(depth, step, "._x := FALSE;");
    out_.line(depth, stepWord("sfc_left", i), " := ", stepWord("sfc_left", i), " OR ", maskOf(i), ";");
  }
  for (const Ident& step : tree_.list(t.to)) {
    const uint32_t i = chart_.index_.of(step.name);
    out_.line(depth, step, "._x := TRUE;");
    out_.line(depth, stepWord("sfc_entered", i), " := ", stepWord("sfc_entered", i), " OR ", maskOf(i), ";");
  }
  out_.line(depth, "sfc_fired := TRUE;");
  if (chart_.flag(SfcFlag::TipMode) != nullptr) out_.line(depth, "sfc_tip := FALSE;");
}

// An IF statement: the first transition whose condition is TRUE fires.
void SfcScheduler::chain(const std::vector<uint32_t>& paths, size_t at, uint32_t depth) {
  const auto prepared = [&](size_t k) {
    const SfcTransition& t = conditionOf(chart_.transitions_[paths[k]]);
    return t.body || chart_.keepsCondition(t);
  };
  if (prepared(at)) prepare(paths[at], depth);
  out_.at(chart_.transitions_[paths[at]].loc);
  for (size_t k = at;; ++k) {
    out_.put(std::string(2 * depth, ' '));
    out_.put(k == at ? "IF " : "ELSIF ");
    condition(paths[k]);
    out_.at(chart_.transitions_[paths[k]].loc);
    out_.put(" THEN\n");
    fire(paths[k], depth + 1);
    if (k + 1 == paths.size()) break;
    if (prepared(k + 1)) {
      out_.line(depth, "ELSE");
      chain(paths, k + 1, depth + 1);
      break;
    }
  }
  out_.line(depth, "END_IF");
}

// The transitions evaluated with each step: a transition from several steps with the first of them.
std::vector<std::vector<uint32_t>> SfcScheduler::waysBySteps() const {
  std::vector<std::vector<uint32_t>> paths(chart_.steps_.size());
  for (uint32_t i = 0; i < chart_.transitions_.size(); ++i)
    if (!chart_.transitions_[i].from.empty())
      paths[chart_.index_.of(tree_.list(chart_.transitions_[i].from)[0].name)].push_back(i);
  // By ascending priority number, then those without a priority, in source order.
  const auto rank = [&](uint32_t i) {
    return chart_.transitions_[i].has_priority ? chart_.transitions_[i].priority : UINT32_MAX;
  };
  for (std::vector<uint32_t>& of : paths)
    std::stable_sort(of.begin(), of.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
  return paths;
}

void SfcScheduler::transitions() {
  const std::vector<std::vector<uint32_t>> paths = waysBySteps();
  std::vector<bool> joined(chart_.steps_.size());  // may be left by a transition that is evaluated with another step
  for (const SfcTransition& t : chart_.transitions_) {
    const std::span<const Ident> from = tree_.list(t.from);
    for (size_t i = 1; i < from.size(); ++i) joined[chart_.index_.of(from[i].name)] = true;
  }
  scan(
      0, "sfc_steps", chart_.steps_.size(), [&](uint32_t i) { return !paths[i].empty(); }, stepNames(),
      [&](uint32_t i, uint32_t depth) {
        const SfcStep& step = chart_.steps_[i];
        const bool guarded = step.min.value || joined[i];
        out_.at(step.name.loc);
        if (guarded) {
          out_.put(std::string(2 * depth, ' ') + "IF ");
          if (joined[i]) {
            out_.put(step.name);
            out_.put(step.min.value ? "._x AND " : "._x");
          }
          if (step.min.value) {
            out_.put(step.name);
            out_.put(".t >= ");
            out_.put(step.min);
          }
          out_.put(" THEN\n");
        }
        chain(paths[i], 0, depth + (guarded ? 1 : 0));
        if (guarded) out_.line(depth, "END_IF");
      });
  if (const Ident* flag = chart_.flag(SfcFlag::Trans)) {
    out_.at(flag->loc);
    out_.line(0, *flag, " := sfc_fired;");
  }
}

void SfcScheduler::run() {
  flags();
  evolve();
  scan(
      0, "sfc_steps", chart_.steps_.size(), [](uint32_t) { return true; }, stepNames(),
      [&](uint32_t i, uint32_t depth) { activeStep(i, depth); });
  actions();
  transitions();
}

// False: a duplicate name, which was reported.
static bool namesDiffer(const Charts& charts, const PouDecl& pou, std::span<const DeclId> made) {
  std::vector<uint32_t> keys;
  forEachSection(charts.tree, pou, made, [&](const SectionDecl& section) {
    for (const DeclId var : charts.tree.list(section.vars))
      for (const Ident& name : charts.tree.list(charts.tree.as<VarDecl>(var).names))
        keys.push_back(charts.names.key(name.name).index);
  });
  for (const DeclId member : charts.tree.list(pou.members))
    if (charts.tree.kind(member) == DeclKind::Pou)
      keys.push_back(charts.names.key(charts.tree.as<PouDecl>(member).name).index);
  std::sort(keys.begin(), keys.end());
  return std::adjacent_find(keys.begin(), keys.end()) == keys.end();
}

std::optional<ScheduledChart> scheduleSfc(const Charts& charts, Signatures& signatures, const PouDecl& pou,
                                          std::span<const DeclId> made, const ChartContext& context) {
  const ChartCheck check = checkSfc(charts, signatures, pou, context);
  if (!check.ok || !namesDiffer(charts, pou, made)) return std::nullopt;
  Chart chart(charts, pou, context);
  chart.findFlags(signatures);
  Writer out(charts, pou.body_begin);
  SfcScheduler(chart, signatures, out, check.crossed).run();
  out.at(pou.body_begin);
  const FileId text = out.finish();
  return ScheduledChart{
      parseStatements(charts.tree, charts.names, charts.sources, text, charts.profile.dialect, charts.diagnostics),
      text};
}

}  // namespace rung::text
