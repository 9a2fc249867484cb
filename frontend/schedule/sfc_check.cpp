// SPDX-License-Identifier: Apache-2.0
// Rules for a chart as a whole. Regions describe which steps can be active together: the region of a step is the set of
// parallel branches that its token represents. A transition to several steps splits a region into as many branches; one
// from several steps unites theirs, and all branches of a split together are the region that was split. A step that
// gets different regions over two paths is the target of a jump into or out of a parallel branch. Cost: one visit of
// each transition.
#include <algorithm>
#include <unordered_set>
#include <vector>

#include "frontend/schedule/diagnostics.h"
#include "frontend/schedule/sfc_schedule.h"
#include "frontend/source/dialect.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {
namespace {

using Region = std::vector<uint32_t>;  // branches, sorted

class Checker {
 public:
  Checker(const Charts& charts, Signatures& signatures, const PouDecl& pou, const ChartContext& context)
      : charts_(charts),
        signatures_(signatures),
        pou_(pou),
        context_(context),
        steps_(charts.tree.list(pou.steps)),
        index_(charts, pou) {}

  bool run();
  bool isCrossed() const { return crossed_; }

 private:
  struct Branch {
    uint32_t split, index;
  };
  struct Split {
    std::vector<uint32_t> targets;  // sorted
    Region parent;
    uint32_t first_branch;
  };

  Report report(Diag diag, Loc loc, std::initializer_list<std::string_view> args) {
    ok_ = false;
    return charts_.diagnostics.report(diag, loc, args);
  }
  std::string_view string(NameId name) const { return charts_.names.string(name); }
  // The keyword before the name of a step becomes another one.
  Fix otherKeyword(Loc name, std::string_view word, std::string_view by, Sureness sureness) const {
    const FileId file = charts_.sources.fileOf(name);
    if (!file) return {};
    const uint32_t base = charts_.sources.begin(file).offset;
    std::string_view before = charts_.sources.original(file).substr(0, name.offset - base);
    while (!before.empty() && isBlankCharacter(before.back())) before.remove_suffix(1);
    if (before.size() < word.size() || !sameIdentifier(before.substr(before.size() - word.size()), word)) return {};
    const Loc end{base + static_cast<uint32_t>(before.size())};
    const Loc begin{end.offset - static_cast<uint32_t>(word.size())};
    return {"Write `" + std::string(by) + "`", {{begin, end, std::string(by)}}, sureness == Sureness::Sure};
  }
  void checkInitial();
  void checkSteps(Slice<Ident> list);
  void checkActions();
  void checkConditions();
  void addUsedConditions(const PouDecl& pou, std::unordered_set<uint32_t>& used) const;
  void checkRegions();
  bool fire(const SfcTransition& t);
  bool unite(const SfcTransition& t, Region& region);
  void reduce(Region& region) const;
  bool concurrent(uint32_t a, uint32_t b) const;
  void ancestors(uint32_t branch, std::vector<uint32_t>& out) const;
  bool enter(const Ident& step, const Region& region);
  uint32_t splitOf(const SfcTransition& t, const Region& parent);

  const Charts& charts_;
  Signatures& signatures_;
  const PouDecl& pou_;
  const ChartContext& context_;
  std::span<const SfcStep> steps_;
  StepIndex index_;
  bool ok_ = true;
  bool crossed_ = false;         // a path enters or leaves a parallel branch
  std::vector<Region> regions_;  // by step; empty: not reached
  std::vector<Split> splits_;
  std::vector<Branch> branches_;
  uint32_t networks_ = 0;  // the first branches are whole networks
};

// Forbids a network of steps with several initial ones, and a chart without one. A POU may contain several networks
// without transitions between them: they run in parallel. IEC 61131-3 ed. 3, 6.7.2; the GRAVEL example of annex F.
//   passes  INITIAL_STEP a: END_STEP  STEP b: END_STEP
//   fails   STEP a: END_STEP                                      E0743
//   fails   INITIAL_STEP a: …  INITIAL_STEP b: …  FROM a TO b     E0731
void Checker::checkInitial() {
  std::vector<uint32_t> network(steps_.size());  // union-find: a step of the same network, or itself
  for (uint32_t i = 0; i < network.size(); ++i) network[i] = i;
  const auto root = [&](uint32_t i) {
    while (network[i] != i) i = network[i] = network[network[i]];
    return i;
  };
  for (const SfcTransition& t : charts_.tree.list(pou_.transitions)) {
    uint32_t first = static_cast<uint32_t>(steps_.size());
    for (const Slice<Ident> list : {t.from, t.to})
      for (const Ident& step : charts_.tree.list(list)) {
        const uint32_t own = index_.of(step.name);
        if (own == steps_.size()) continue;
        if (first == steps_.size()) first = own;
        network[root(own)] = root(first);
      }
  }
  std::vector<uint32_t> initial(steps_.size(), static_cast<uint32_t>(steps_.size()));  // by root
  bool any = false;
  for (uint32_t i = 0; i < steps_.size(); ++i) {
    if (!steps_[i].initial) continue;
    any = true;
    uint32_t& first = initial[root(i)];
    if (first == steps_.size()) {
      first = i;
      continue;
    }
    report(diag::SfcSeveralInitial, steps_[i].name.loc, {string(steps_[i].name.name)})
        .alsoDeclaredHere(steps_[first].name.loc)
        .fix(otherKeyword(steps_[i].name.loc, "INITIAL_STEP", "STEP", Sureness::Proposal));
    return;
  }
  if (any) return;
  Report report_of_chart = report(diag::SfcNoInitial, steps_.empty() ? pou_.body_begin : steps_[0].name.loc,
                                  {string(pou_.name), steps_.empty() ? "Start" : string(steps_[0].name.name)});
  if (!steps_.empty()) report_of_chart.fix(otherKeyword(steps_[0].name.loc, "STEP", "INITIAL_STEP", Sureness::Sure));
}

// Forbids transitions from and to undefined steps. IEC 61131-3 ed. 3, 6.7.3.
//   fails   TRANSITION FROM a TO nowhere := x; END_TRANSITION        E0732
void Checker::checkSteps(Slice<Ident> list) {
  for (const Ident& step : charts_.tree.list(list)) {
    if (index_.of(step.name) < steps_.size()) continue;
    std::vector<std::string_view> candidates;
    for (const SfcStep& known : steps_) candidates.push_back(string(known.name.name));
    report(diag::SfcUnknownStep, step.loc, {string(step.name)}).didYouMean(nearest(string(step.name), candidates));
  }
}

// Forbids an association with an undefined action. IEC 61131-3 ed. 3 table 56; TM/TP manual 5.5.2.2.
//   passes  STEP a: open(N); END_STEP  ACTION open: …        fails   STEP a: opem(N); END_STEP       E0733
void Checker::checkActions() {
  for (const SfcStep& step : steps_) {
    for (const SfcAssociation& a : charts_.tree.list(step.actions)) {
      const SignatureKind kind = signatures_.of(a.action.name).kind;
      if (kind == SignatureKind::Method || kind == SignatureKind::Value || kind == SignatureKind::Instance) continue;
      std::vector<std::string_view> candidates;
      std::vector<const PouDecl*> seen = {&pou_};
      seen.insert(seen.end(), context_.around.begin(), context_.around.end());
      for (const PouDecl* pou : seen)
        for (const DeclId member : charts_.tree.list(pou->members))
          if (charts_.tree.kind(member) == DeclKind::Pou)
            candidates.push_back(string(charts_.tree.as<PouDecl>(member).name));
      report(diag::SfcUnknownAction, a.action.loc, {string(a.action.name)})
          .didYouMean(nearest(string(a.action.name), candidates));
    }
  }
}

void Checker::ancestors(uint32_t branch, std::vector<uint32_t>& out) const {
  if (std::find(out.begin(), out.end(), branch) != out.end()) return;
  out.push_back(branch);
  if (branch < networks_) return;
  for (const uint32_t parent : splits_[branches_[branch].split].parent) ancestors(parent, out);
}

// Tells whether they are in different branches of one split.
bool Checker::concurrent(uint32_t a, uint32_t b) const {
  std::vector<uint32_t> of_a, of_b;
  ancestors(a, of_a);
  ancestors(b, of_b);
  for (const uint32_t x : of_a)
    for (const uint32_t y : of_b)
      if (x >= networks_ && y >= networks_ && branches_[x].split == branches_[y].split &&
          branches_[x].index != branches_[y].index)
        return true;
  return false;
}

// Replaces all branches of a split by the region that was split.
void Checker::reduce(Region& region) const {
  for (bool again = true; again;) {
    again = false;
    for (const uint32_t branch : region) {
      if (branch < networks_) continue;
      const Split& split = splits_[branches_[branch].split];
      const auto holds = [&](uint32_t b) { return std::binary_search(region.begin(), region.end(), b); };
      bool all = true;
      for (uint32_t i = 0; i < split.targets.size(); ++i) all = all && holds(split.first_branch + i);
      if (!all) continue;
      Region next;
      for (const uint32_t b : region)
        if (b < split.first_branch || b >= split.first_branch + split.targets.size()) next.push_back(b);
      next.insert(next.end(), split.parent.begin(), split.parent.end());
      std::sort(next.begin(), next.end());
      region = std::move(next);
      again = true;
      break;
    }
  }
}

// Forbids a transition from steps that are never all active together. IEC 61131-3 ed. 3 table 61, 4c.
//   fails   TRANSITION FROM a TO b …  TRANSITION FROM (a, b) TO c …        E0737
bool Checker::unite(const SfcTransition& t, Region& region) {
  const std::span<const Ident> from = charts_.tree.list(t.from);
  for (size_t i = 0; i < from.size(); ++i) {
    const Region& own = regions_[index_.of(from[i].name)];
    for (size_t k = 0; k < i; ++k) {
      for (const uint32_t a : own) {
        for (const uint32_t b : regions_[index_.of(from[k].name)]) {
          if (crossed_ || concurrent(a, b)) continue;
          report(diag::SfcNeverTogether, from[i].loc, {string(from[k].name), string(from[i].name)});
          return false;
        }
      }
    }
    region.insert(region.end(), own.begin(), own.end());
  }
  std::sort(region.begin(), region.end());
  reduce(region);
  return true;
}

// Forbids jumps into and out of parallel branches, and charts that activate a step twice: two paths to a step must come
// from the same branches. IEC 61131-3 ed. 3, 6.7.5; TM/TP manual 5.5.2.4. In codesys a branch may end with a jump, and
// the others stay active: CODESYS, "SFC Element: Jump", "Processing Order in SFC"; Automation Builder, "Parallel
// branch".
//   fails   FROM a TO (b, c) …  FROM b TO a …        E0738, in codesys W1022, once for a chart
bool Checker::enter(const Ident& step, const Region& region) {
  Region& own = regions_[index_.of(step.name)];
  if (own.empty()) own = region;
  if (own == region) return true;
  if (charts_.profile.crossed_branches) {
    if (!crossed_) charts_.diagnostics.report(diag::SfcBranchLeft, step.loc, {string(step.name)});
    return crossed_ = true;
  }
  report(diag::SfcBranchCrossed, step.loc, {string(step.name)});
  return false;
}

uint32_t Checker::splitOf(const SfcTransition& t, const Region& parent) {
  std::vector<uint32_t> targets;
  for (const Ident& step : charts_.tree.list(t.to)) targets.push_back(index_.of(step.name));
  std::sort(targets.begin(), targets.end());
  for (uint32_t i = 0; i < splits_.size(); ++i)
    if (splits_[i].targets == targets && splits_[i].parent == parent) return i;
  const auto index = static_cast<uint32_t>(splits_.size());
  splits_.push_back({targets, parent, static_cast<uint32_t>(branches_.size())});
  for (uint32_t i = 0; i < targets.size(); ++i) branches_.push_back({index, i});
  return index;
}

bool Checker::fire(const SfcTransition& t) {
  Region region;
  if (!unite(t, region)) return false;
  const std::span<const Ident> to = charts_.tree.list(t.to);
  if (to.size() == 1) return enter(to[0], region);
  const uint32_t split = splitOf(t, region);
  for (const Ident& step : to) {
    const uint32_t target = index_.of(step.name);
    const std::vector<uint32_t>& targets = splits_[split].targets;
    const auto index = static_cast<uint32_t>(std::find(targets.begin(), targets.end(), target) - targets.begin());
    if (!enter(step, {splits_[split].first_branch + index})) return false;
  }
  return true;
}

void Checker::checkRegions() {
  regions_.resize(steps_.size());
  for (size_t i = 0; i < steps_.size(); ++i) {
    if (!steps_[i].initial) continue;
    branches_.push_back({});
    regions_[i] = {networks_++};
  }
  const std::span<const SfcTransition> transitions = charts_.tree.list(pou_.transitions);
  std::vector<bool> fired(transitions.size());
  std::vector<std::vector<uint32_t>> leaving(steps_.size());
  std::vector<uint32_t> work;
  for (uint32_t i = 0; i < transitions.size(); ++i)
    for (const Ident& step : charts_.tree.list(transitions[i].from)) leaving[index_.of(step.name)].push_back(i);
  for (uint32_t s = 0; s < steps_.size(); ++s)
    if (steps_[s].initial) work.push_back(s);
  while (!work.empty()) {
    const uint32_t step = work.back();
    work.pop_back();
    for (const uint32_t i : leaving[step]) {
      const SfcTransition& t = transitions[i];
      bool ready = !fired[i];
      for (const Ident& from : charts_.tree.list(t.from)) ready = ready && !regions_[index_.of(from.name)].empty();
      if (!ready) continue;
      fired[i] = true;
      std::vector<uint32_t> fresh;
      for (const Ident& to : charts_.tree.list(t.to)) {
        const uint32_t target = index_.of(to.name);
        if (regions_[target].empty()) fresh.push_back(target);
      }
      if (!fire(t)) return;
      work.insert(work.end(), fresh.rbegin(), fresh.rend());
    }
  }
  if (charts_.diagnostics.hasErrors()) return;  // transitions may have been dropped
  for (size_t i = 0; i < steps_.size(); ++i)
    if (regions_[i].empty())
      charts_.diagnostics.report(diag::SfcUnreachable, steps_[i].name.loc, {string(steps_[i].name.name)});
}

// The names of the declarations from which the transitions of the chart, and of charts in actions and methods of the
// POU, take their conditions: by key.
void Checker::addUsedConditions(const PouDecl& pou, std::unordered_set<uint32_t>& used) const {
  for (const SfcTransition& t : charts_.tree.list(pou.transitions))
    if (!t.from.empty() && !t.body && !t.condition.value) used.insert(charts_.names.key(t.name.name).index);
  for (const DeclId member : charts_.tree.list(pou.members))
    if (charts_.tree.kind(member) == DeclKind::Pou) addUsedConditions(charts_.tree.as<PouDecl>(member), used);
}

// Warns of a condition without steps that no transition uses.
//   warns   TRANSITION t := go; END_TRANSITION                    W0747
void Checker::checkConditions() {
  std::unordered_set<uint32_t> used;
  addUsedConditions(pou_, used);
  for (const SfcTransition& t : charts_.tree.list(pou_.transitions))
    if (t.from.empty() && t.to.empty() && used.count(charts_.names.key(t.name.name).index) == 0)
      charts_.diagnostics.report(diag::SfcConditionUnused, t.name.loc, {string(t.name.name)});
}

bool Checker::run() {
  checkInitial();
  checkConditions();
  for (const SfcTransition& t : charts_.tree.list(pou_.transitions)) {
    checkSteps(t.from);
    checkSteps(t.to);
    const std::span<const Ident> from = charts_.tree.list(t.from), to = charts_.tree.list(t.to);
    // Forbids a transition to the step that it leaves, in codesys. TM/TP manual 5.5.2.4.
    if (!charts_.profile.transitions_to_same_step && from.size() == 1 && to.size() == 1 &&
        charts_.names.same(from[0].name, to[0].name))
      charts_.diagnostics.report(diag::SfcSameStep, to[0].loc, {string(to[0].name)});
  }
  checkActions();
  if (ok_) checkRegions();
  return ok_;
}

}  // namespace

ChartCheck checkSfc(const Charts& charts, Signatures& signatures, const PouDecl& pou, const ChartContext& context) {
  Checker checker(charts, signatures, pou, context);
  const bool ok = checker.run();
  return {ok, checker.isCrossed()};
}

}  // namespace rung::text
