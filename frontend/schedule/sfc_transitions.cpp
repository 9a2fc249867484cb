// SPDX-License-Identifier: Apache-2.0
// The transitions of a chart, as the statements at the end of its cycle; see sfc_scheduler.h.
#include <algorithm>

#include "frontend/schedule/sfc_scheduler.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

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

// Tells whether a statement before the IF computes its condition.
bool SfcScheduler::isPrepared(uint32_t way) const {
  return chart_.keepsCondition(conditionOf(chart_.transitions_[way]));
}

void SfcScheduler::prepare(uint32_t way) {
  const SfcTransition& t = conditionOf(chart_.transitions_[way]);
  make_.at(t.loc);
  if (t.body)
    make_.callStatement(make_.call(make_.name(tree_.as<PouDecl>(t.body).name)));
  else
    make_.assign(make_.name(t.target.name), make_.quote(t.condition.value));
}

// The condition of a transition itself.
ExprId SfcScheduler::ownCondition(const SfcTransition& t, bool joins) {
  const bool quoted = t.condition.value && !chart_.keepsCondition(t);
  const ExprId own = quoted ? make_.quote(t.condition.value) : make_.name(t.target.name ? t.target.name : t.name.name);
  if (chart_.flag(SfcFlag::TipMode) != nullptr)
    return make_.call("SEL", {flag(SfcFlag::TipMode), own, make_.name("sfc_tip")});
  return quoted && joins ? make_.inParens(own) : own;
}

ExprId SfcScheduler::condition(uint32_t way) {
  const SfcTransition& fired = chart_.transitions_[way];
  const SfcTransition& t = conditionOf(fired);
  const std::span<const Ident> from = tree_.list(fired.from);
  make_.at(fired.loc);
  ExprId before;
  for (size_t i = 1; i < from.size(); ++i) {
    before = make_.both(before, step(from[i], "x"));
    before = make_.both(before, step(from[i], "_x"));
  }
  const bool constant =
      t.condition.value && !chart_.keepsCondition(t) && tree_.kind(t.condition.value) == ExprKind::Literal;
  if (constant && !before && chart_.flag(SfcFlag::TipMode) == nullptr) before = step(from[0], "x");  // no IF on it
  for (size_t i = 1; i < from.size(); ++i) {
    const SfcStep& left = chart_.steps_[chart_.index_.of(from[i].name)];
    if (!left.min.value) continue;
    before = make_.both(before, make_.binary(BinaryOp::GreaterEqual, step(left, "t"), make_.quote(left.min.value)));
  }
  return make_.both(before, ownCondition(t, from.size() > 1));
}

void SfcScheduler::fire(uint32_t way) {
  const SfcTransition& t = chart_.transitions_[way];
  make_.at(t.loc);
  for (const Ident& left : tree_.list(t.from)) {
    make_.set(step(left, "_x"), false);
    add(SfcSet::Left, chart_.index_.of(left.name));
  }
  for (const Ident& entered : tree_.list(t.to)) {
    make_.set(step(entered, "_x"), true);
    add(SfcSet::Entered, chart_.index_.of(entered.name));
  }
  make_.set(make_.name("sfc_fired"), true);
  if (chart_.flag(SfcFlag::TipMode) != nullptr) make_.set(make_.name("sfc_tip"), false);
}

// An IF statement: the first transition whose condition is TRUE fires.
void SfcScheduler::chain(const std::vector<uint32_t>& ways, size_t at) {
  if (isPrepared(ways[at])) prepare(ways[at]);
  const Loc loc = chart_.transitions_[ways[at]].loc;
  std::vector<IfBranch> branches;
  Slice<StmtId> otherwise;
  for (size_t k = at;; ++k) {
    const ExprId holds = condition(ways[k]);
    branches.push_back({holds, make_.list([&] { fire(ways[k]); })});
    if (k + 1 == ways.size()) break;
    if (!isPrepared(ways[k + 1])) continue;
    otherwise = make_.list([&] { chain(ways, k + 1); });
    break;
  }
  make_.ifStatement(branches, otherwise, loc);
}

// The transitions evaluated with each step: a transition from several steps with the first of them.
std::vector<std::vector<uint32_t>> SfcScheduler::waysBySteps() const {
  std::vector<std::vector<uint32_t>> ways(chart_.steps_.size());
  for (uint32_t i = 0; i < chart_.transitions_.size(); ++i)
    if (!chart_.transitions_[i].from.empty())
      ways[chart_.index_.of(tree_.list(chart_.transitions_[i].from)[0].name)].push_back(i);
  // By ascending priority number, then those without a priority, in source order.
  const auto rank = [&](uint32_t i) {
    return chart_.transitions_[i].has_priority ? chart_.transitions_[i].priority : UINT32_MAX;
  };
  for (std::vector<uint32_t>& of : ways)
    std::stable_sort(of.begin(), of.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
  return ways;
}

// The ways out of an active step. `joined`: a transition that is evaluated with another step may have left it.
void SfcScheduler::leaveStep(uint32_t i, const std::vector<uint32_t>& ways, bool joined) {
  const SfcStep& left = chart_.steps_[i];
  ExprId guard;
  if (joined) guard = step(left, "_x");
  if (left.min.value)
    guard = make_.both(guard, make_.binary(BinaryOp::GreaterEqual, step(left, "t"), make_.quote(left.min.value)));
  if (guard)
    make_.when(guard, [&] { chain(ways, 0); });
  else
    chain(ways, 0);
}

void SfcScheduler::transitions() {
  const std::vector<std::vector<uint32_t>> ways = waysBySteps();
  std::vector<bool> joined(chart_.steps_.size());
  for (const SfcTransition& t : chart_.transitions_) {
    const std::span<const Ident> from = tree_.list(t.from);
    for (size_t i = 1; i < from.size(); ++i) joined[chart_.index_.of(from[i].name)] = true;
  }
  const auto isLeft = [&](uint32_t i) { return !ways[i].empty(); };
  scan(SfcSet::Steps, isLeft, [&](uint32_t i) { leaveStep(i, ways[i], joined[i]); });
  if (const Ident* trans = chart_.flag(SfcFlag::Trans)) {
    make_.at(trans->loc);
    make_.assign(make_.name(trans->name), make_.name("sfc_fired"));
  }
}

}  // namespace rung::text
