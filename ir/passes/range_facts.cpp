// SPDX-License-Identifier: Apache-2.0
// See range_facts.h.
#include "ir/passes/range_facts.h"

#include "ir/passes/effects.h"
#include "ir/passes/support.h"

namespace rung::ir {

RangeFacts::RangeFacts(const Module& module, const Exposure& exposure, const Body& body)
    : module_(module), exposure_(exposure), body_(body), variables_(module, exposure, body) {
  facts_.assign(variables_.count(), {});
  stamp_.assign(facts_.size(), 0);
  stamp_entry_.assign(facts_.size(), 0);
}

Interval RangeFacts::allOf(TypeId type, bool with_bounds) {
  if (variables_.isPointer(type)) return kPointers;
  if (type.index >= kKinds) return intervalOf(module_.types, type, with_bounds);
  if (!kind_known_[type.index]) {
    kind_known_[type.index] = true;
    kind_interval_[type.index] = intervalOf(module_.types, type, false);
  }
  return kind_interval_[type.index];
}

void RangeFacts::set(uint32_t variable, const Fact& fact) {
  trail_.push_back({variable, facts_[variable]});
  facts_[variable] = fact;
  facts_[variable].epoch = epochOf(variable);
}

void RangeFacts::narrow(uint32_t variable, const Interval& bounds) {
  const Interval now = current(variable);
  const Interval both = meet(now, bounds);
  if (both.isEmpty() || both == now) return;  // empty: never reached
  set(variable, both);
}

// ---- what statements do

void RangeFacts::forgetFields() {
  ++epoch_;
  ++exposed_epoch_;
}

void RangeFacts::written(ExprId place) {
  const Effect effect = effectOfWrite(module_, body_, variables_.privateLocals(), place);
  switch (effect.kind) {
    case Effect::None: return;
    case Effect::Local: return set(effect.index, Fact{});
    case Effect::Field: return set(variables_.numberOfField(effect.index), Fact{});
    case Effect::Exposed: ++exposed_epoch_; return;
    case Effect::Fields: return forgetFields();
  }
}

void RangeFacts::effectsOf(const Stmt& stmt) {
  forEachWritten(module_, body_, stmt, [&](ExprId place) { written(place); });
  if (bindsOwn(body_, stmt)) forgetFields();
  const auto* call = stmt.tryAs<CallStmt>();
  if (call == nullptr || module_.body(call->callee).pure) return;
  ++exposed_epoch_;
  if (callReachesSelf(module_, exposure_, body_, *call)) ++epoch_;
}

void RangeFacts::effectsIn(StmtId first) {
  forEachStmt(body_, first, [&](StmtId id) { effectsOf(body_.stmt(id)); });
}

// ---- branches

void RangeFacts::undo(size_t mark) {
  while (trail_.size() > mark) {
    facts_[trail_.back().variable] = trail_.back().before;
    trail_.pop_back();
  }
}

void RangeFacts::collectTouched(size_t mark) {
  const uint32_t now = ++stamps_;
  for (size_t i = trail_.size(); i-- > mark;) {
    const uint32_t v = trail_[i].variable;
    if (stamp_[v] == now) continue;
    stamp_[v] = now;
    Fact left = facts_[v];
    left.known = holds(v, left);
    touched_.push_back({v, 1, left});
  }
}

// A branch that did not touch a variable keeps the fact from before.
void RangeFacts::join(const Junction& at) {
  const uint32_t now = ++stamps_;
  size_t count = at.first;
  for (size_t i = at.first; i < touched_.size(); ++i) {
    const Touched one = touched_[i];
    if (stamp_[one.variable] != now) {
      stamp_[one.variable] = now;
      stamp_entry_[one.variable] = static_cast<uint32_t>(count);
      touched_[count++] = one;
      continue;
    }
    Touched& entry = touched_[stamp_entry_[one.variable]];
    ++entry.branches;
    entry.fact.known = entry.fact.known && one.fact.known;
    entry.fact.interval = ir::join(entry.fact.interval, one.fact.interval);
  }
  for (size_t i = at.first; i < count; ++i) {
    Touched entry = touched_[i];
    if (entry.branches < at.falling) {
      const Fact& before = facts_[entry.variable];
      entry.fact.known = entry.fact.known && holds(entry.variable, before);
      entry.fact.interval = ir::join(entry.fact.interval, before.interval);
    }
    set(entry.variable, entry.fact);
  }
  touched_.resize(at.first);
}

}  // namespace rung::ir
