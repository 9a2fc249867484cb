// SPDX-License-Identifier: Apache-2.0
// Range analysis knows this at a place of a body: an interval for each variable of known_variables.h; of a pointer it
// tells whether it may be null. Changes go to a trail, so that the end of a branch takes them back; where branches
// meet, what they left is joined. Used by remove_checks.cpp, which walks the statements.
#pragma once

#include "ir/passes/known_variables.h"

namespace rung::ir {

inline constexpr Int128 kWide = Int128{1} << 100;  // beyond every integer: proves nothing
inline constexpr Interval kPointers{0, kWide}, kNotNull{1, kWide};

class RangeFacts {
 public:
  static constexpr uint32_t kNone = KnownVariables::kNone;

  RangeFacts(const Module& module, const Exposure& exposure, const Body& body);

  const KnownVariables& variables() const { return variables_; }

  // All values of a type; those of a subrange with `with_bounds`.
  Interval allOf(TypeId type, bool with_bounds);
  Interval all(uint32_t variable) {
    return variables_.isLocal(variable) || variables_.isField(variable) ? allOf(variables_.typeOf(variable), true)
                                                                        : kPointers;
  }
  bool isKnown(uint32_t variable) const { return holds(variable, facts_[variable]); }
  Interval current(uint32_t variable) { return isKnown(variable) ? facts_[variable].interval : all(variable); }
  void set(uint32_t variable, const Interval& interval) { set(variable, Fact{true, 0, interval}); }
  // From here on the variable is within the bounds, too.
  void narrow(uint32_t variable, const Interval& bounds);

  // ---- what statements do
  void written(ExprId place);
  void effectsOf(const Stmt& stmt);  // of the statement itself, not of its blocks
  void effectsIn(StmtId first);      // of all statements and blocks

  // ---- branches
  size_t mark() const { return trail_.size(); }
  void undo(size_t mark);
  // f(variable, interval): each variable that lost its fact since the mark, with what was known of it, once.
  template <class F>
  void forEachForgotten(size_t mark, F&& f);

  // Branches that begin at one place: walk each with branch(), then join().
  struct Junction {
    size_t first;  // of touched_
    uint32_t falling = 0;
  };
  Junction junction() const { return {touched_.size()}; }
  // walk() follows a branch and says whether control leaves its end; what it changed is taken back.
  template <class Walk>
  void branch(Junction& at, Walk&& walk);
  void join(const Junction& at);
  void discard(const Junction& at) { touched_.resize(at.first); }

 private:
  struct Fact {
    bool known = false;
    uint32_t epoch = 0;  // of a field of self: valid until something unknown may write it
    Interval interval;
  };
  struct Change {
    uint32_t variable;
    Fact before;
  };
  struct Touched {  // the fact that a branch left for a variable that it touched
    uint32_t variable;
    uint32_t branches;
    Fact fact;
  };

  // Epochs of fields of self: one counts the statements that may write any of them, the other also those that reach a
  // field only by its address.
  uint32_t epochOf(uint32_t variable) const { return variables_.isExposed(variable) ? exposed_epoch_ : epoch_; }
  bool holds(uint32_t variable, const Fact& fact) const {
    return fact.known && (variables_.isLocal(variable) || fact.epoch == epochOf(variable));
  }
  void set(uint32_t variable, const Fact& fact);
  void forgetFields();
  void collectTouched(size_t mark);

  const Module& module_;
  const Exposure& exposure_;
  const Body& body_;
  KnownVariables variables_;
  static constexpr size_t kKinds = static_cast<size_t>(types::TypeKind::Count_);
  Interval kind_interval_[kKinds];
  bool kind_known_[kKinds] = {};
  std::vector<Fact> facts_;  // by variable
  std::vector<uint32_t> stamp_, stamp_entry_;
  std::vector<Change> trail_;
  std::vector<Touched> touched_;
  uint32_t epoch_ = 0, exposed_epoch_ = 0, stamps_ = 0;
};

template <class F>
void RangeFacts::forEachForgotten(size_t mark, F&& f) {
  const uint32_t now = ++stamps_;
  for (size_t i = mark; i < trail_.size(); ++i) {
    const auto& [variable, before] = trail_[i];
    if (stamp_[variable] == now) continue;
    stamp_[variable] = now;
    if (holds(variable, before)) f(variable, before.interval);
  }
}

template <class Walk>
void RangeFacts::branch(Junction& at, Walk&& walk) {
  const size_t begin = mark();
  if (walk()) {
    collectTouched(begin);
    ++at.falling;
  }
  undo(begin);
}

}  // namespace rung::ir
