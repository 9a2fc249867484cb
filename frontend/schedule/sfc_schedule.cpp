// SPDX-License-Identifier: Apache-2.0
// Makes the statements of a cycle of a chart; see sfc_schedule.h. In this order (TM/TP manual 5.5; syntax
// manual 5.9.8):
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

// ---- sets

static const char* nameOf(SfcSet set) {
  switch (set) {
    case SfcSet::Steps: return "sfc_steps";
    case SfcSet::Left: return "sfc_left";
    case SfcSet::Entered: return "sfc_entered";
    case SfcSet::Actions: return "sfc_actions";
  }
  return "";
}

Loc SfcScheduler::locOf(SfcSet set, uint32_t member) const {
  return set == SfcSet::Actions ? chart_.actions_[member].loc : chart_.steps_[member].name.loc;
}

ExprId SfcScheduler::currentWord(SfcSet set) {
  const ExprId whole = make_.name(nameOf(set));
  return chart_.words(sizeOf(set)) <= 1 ? whole : make_.element(whole, make_.name("sfc_word"));
}

ExprId SfcScheduler::wordOf(SfcSet set, uint32_t member) {
  const ExprId whole = make_.name(nameOf(set));
  return chart_.words(sizeOf(set)) <= 1 ? whole : make_.element(whole, make_.number(member / kWord));
}

void SfcScheduler::add(SfcSet set, uint32_t member) {
  const ExprId mask = make_.bits(bitOf(member));
  make_.assign(wordOf(set, member), make_.binary(BinaryOp::Or, wordOf(set, member), mask));
}

void SfcScheduler::remove(SfcSet set, uint32_t member) {
  const ExprId mask = make_.negation(make_.bits(bitOf(member)));
  make_.assign(wordOf(set, member), make_.both(wordOf(set, member), mask));
}

void SfcScheduler::forWords(SfcSet set, FunctionRef<void()> body) {
  const uint32_t words = chart_.words(sizeOf(set));
  if (words <= 1) return body();
  make_.count(make_.name("sfc_word"), make_.number(0), make_.number(words - 1), body);
}

void SfcScheduler::scan(SfcSet set, FunctionRef<bool(uint32_t)> wanted, FunctionRef<void(uint32_t)> branch) {
  const auto count = static_cast<uint32_t>(sizeOf(set));
  uint32_t first = 0;
  while (first < count && !wanted(first)) ++first;
  if (first == count) return;
  make_.at(chart_.pou_.body_begin);
  const auto takeMembers = [&] {
    ExprId selector = make_.call("SFCTakeBit", {make_.name("sfc_set")});
    if (chart_.words(count) > 1)
      selector = make_.binary(BinaryOp::Add,
                              make_.binary(BinaryOp::Multiply, make_.name("sfc_word"), make_.number(kWord)), selector);
    std::vector<CaseBranch> branches;
    for (uint32_t i = first; i < count; ++i) {
      if (!wanted(i)) continue;
      make_.at(locOf(set, i));
      const Slice<ExprId> labels = make_.labels(make_.number(i));
      branches.push_back({labels, make_.list([&] { branch(i); })});
    }
    make_.at(chart_.pou_.body_begin);
    make_.select(selector, branches);
  };
  forWords(set, [&] {
    make_.assign(make_.name("sfc_set"), currentWord(set));
    make_.loopWhile(make_.binary(BinaryOp::NotEqual, make_.name("sfc_set"), make_.noBits()), takeMembers);
  });
}

// ---- steps and actions

// The entry, active or exit actions of a step.
void SfcScheduler::run(const SfcStep& step, SfcQualifier when) {
  for (const SfcAssociation& a : tree_.list(step.actions)) {
    if (a.qualifier != when) continue;
    make_.at(a.action.loc);
    if (callsAction(a.action))
      make_.callStatement(make_.call(make_.path(a.action.name)));
    else
      make_.set(make_.path(a.action.name), true);
  }
}

void SfcScheduler::enter(const SfcStep& entered) {
  make_.set(step(entered, "x"), true);
  make_.set(step(entered, "_x"), true);
  make_.assign(step(entered, "_t"), make_.name("sfc_now"));
  make_.assign(step(entered, "t"), make_.noTime());
  run(entered, SfcQualifier::Entry);
}

// Applies the transitions that fired in the last cycle.
void SfcScheduler::evolve() {
  make_.at(chart_.pou_.body_begin);
  make_.when(make_.name("sfc_fired"), [&] {
    make_.set(make_.name("sfc_fired"), false);
    scan(SfcSet::Left, allMembers, [&](uint32_t i) {
      make_.set(step(chart_.steps_[i], "x"), false);
      run(chart_.steps_[i], SfcQualifier::Exit);
    });
    scan(SfcSet::Entered, allMembers, [&](uint32_t i) {
      const SfcStep& entered = chart_.steps_[i];
      if (crossed_)  // it may be active: another branch is in it
        make_.when(make_.negation(step(entered, "x")), [&] { enter(entered); });
      else
        enter(entered);
    });
    forWords(SfcSet::Steps, [&] {
      const ExprId remaining = make_.both(currentWord(SfcSet::Steps), make_.negation(currentWord(SfcSet::Left)));
      make_.assign(currentWord(SfcSet::Steps), make_.binary(BinaryOp::Or, remaining, currentWord(SfcSet::Entered)));
      clearWords(SfcSet::Left);
      clearWords(SfcSet::Entered);
    });
  });
}

void SfcScheduler::activeStep(const SfcStep& active) {
  make_.assign(step(active, "t"), make_.binary(BinaryOp::Subtract, make_.name("sfc_now"), step(active, "_t")));
  timeLimit(active);
  make_.at(active.name.loc);
  if (chart_.flag(SfcFlag::CurrentStep) != nullptr)
    make_.assign(flag(SfcFlag::CurrentStep), make_.text(chart_.string(active.name.name)));
  run(active, SfcQualifier::Active);
  for (const SfcAssociation& a : tree_.list(active.actions)) {
    if (!isControlled(a.qualifier)) continue;
    make_.at(a.loc);
    const uint32_t action = chart_.actionOf(a.action.name);
    make_.set(control(action, keywordOf(a.qualifier)), true);
    if (a.time.value) make_.assign(control(action, "T"), make_.quote(a.time.value));
    add(SfcSet::Actions, action);
  }
}

void SfcScheduler::controlAction(uint32_t i) {
  const Ident& action = chart_.actions_[i];
  make_.callBlock(control(i), "now", make_.name("sfc_now"));
  if (callsAction(action)) {
    const ExprId ended = make_.both(control(i, "x"), make_.negation(control(i, "_x")));
    make_.when(ended, [&] { make_.callStatement(make_.call(make_.path(action.name))); });
  } else {
    make_.assign(make_.path(action.name), control(i, "_x"));
  }
  make_.when(make_.negation(control(i, "busy")), [&] { remove(SfcSet::Actions, i); });
}

void SfcScheduler::actions() {
  scan(SfcSet::Actions, allMembers, [&](uint32_t i) { controlAction(i); });
  const auto isCalled = [&](uint32_t i) { return callsAction(chart_.actions_[i]); };
  scan(SfcSet::Actions, isCalled, [&](uint32_t i) {
    const Ident& action = chart_.actions_[i];
    make_.when(control(i, "_x"), [&] { make_.callStatement(make_.call(make_.path(action.name))); });
  });
}

Slice<StmtId> SfcScheduler::run() {
  return make_.list([&] {
    flags();
    evolve();
    scan(SfcSet::Steps, allMembers, [&](uint32_t i) { activeStep(chart_.steps_[i]); });
    actions();
    transitions();
  });
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

std::optional<Slice<StmtId>> scheduleSfc(const Charts& charts, Signatures& signatures, const PouDecl& pou,
                                         const ChartContext& context) {
  const ChartCheck check = checkSfc(charts, signatures, pou, context);
  if (!check.ok || !namesDiffer(charts, pou, signatures.madeSections(pou))) return {};
  Chart chart(charts, pou, context);
  chart.findFlags(signatures);
  return SfcScheduler(chart, signatures, check.crossed).run();
}

}  // namespace rung::text
