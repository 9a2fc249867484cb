// SPDX-License-Identifier: Apache-2.0
// Counters: how often a FOR runs at most, and how far an iteration moves the variables that its body only counts up or
// down by constants (`n := n + 1`). In: a body. Out: bounds for every iteration, which hold whatever else the loop
// does. Called by remove_checks.cpp, whose intervals alone cannot tell that `n` grows as often as the loop runs.
//   cost  one walk of a loop's body
#pragma once

#include <optional>
#include <vector>

#include "ir/passes/known_variables.h"

namespace rung::ir {

// How far one iteration moves a variable at most.
struct Growth {
  Int128 down = 0, up = 0;
  Interval limit;          // what the types on the way can hold
  bool is_counted = true;  // false: something else writes it, too
};

class Counters {
 public:
  Counters(const Module& module, const Exposure& exposure, const Body& body, const KnownVariables& variables)
      : module_(module), exposure_(exposure), body_(body), variables_(variables) {}

  // The iterations of a FOR; none: unknown. Without facts: `FOR i := 1 TO 8` and `FOR i := x - 1 TO x + 1`, which runs
  // three times or, where x + 1 wraps, not at all.
  std::optional<Int128> mostIterations(const ForStmt& loop) const;
  // The effect of one pass through the block on each of the variables.
  std::vector<Growth> growthIn(StmtId block, const std::vector<uint32_t>& variables) const;

 private:
  struct Sum {  // variable + addend, cut to a type
    uint32_t variable;
    Int128 addend;
    TypeId type;
  };
  using Growths = std::vector<Growth>;

  uint32_t variable(ExprId id) const { return counted(variables_.at(id)); }
  uint32_t variableAfter(ExprId id) const { return counted(variables_.after(id)); }
  uint32_t counted(uint32_t variable) const;  // no pointer
  std::optional<Int128> constant(ExprId id) const;
  std::optional<Sum> sumOf(ExprId id) const;
  void add(StmtId block, const std::vector<uint32_t>& variables, Growths& to) const;
  void addStmt(const Stmt& stmt, const std::vector<uint32_t>& variables, Growths& to) const;
  void addLoop(StmtId block, const ForStmt* loop, const std::vector<uint32_t>& variables, Growths& to) const;
  void addBranches(const std::vector<StmtId>& blocks, const std::vector<uint32_t>& variables, Growths& to) const;
  bool count(const AssignStmt& assign, Growth& growth) const;
  bool mayWrite(const Stmt& stmt, uint32_t variable) const;

  const Module& module_;
  const Exposure& exposure_;
  const Body& body_;
  const KnownVariables& variables_;
};

}  // namespace rung::ir
