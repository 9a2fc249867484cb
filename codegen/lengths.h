// SPDX-License-Identifier: Apache-2.0
// Lengths of strings in C++ locals. A string that sized functions use keeps its length beside it, so nothing counts its
// characters again: `s := CONCAT(s, c)` appends at the end, MID knows whether its position is inside. Every write of
// such a string sets its length. The length is counted before the first use in a block; a loop counts in front what it
// will need. Memory stays NUL-terminated after each statement.
// A shared string, which more than this body may reach while it runs (an in-out, a variable whose address left the
// body), loses its length with each statement that may change it by another name (foreign_writes.h): the local is
// RUNG_UNCOUNTED until it is needed again. A function gets the lengths of its in-outs from the caller and leaves there
// what it knows at its end (passesLength in signature.h). A shared string may be longer than its type says: a variable
// of a longer type was passed.
// Sized functions are natives marked {sized}: their second form in rung/<library>.h takes the length after each string
// and returns the length of the result. Of a generic function the instances for STRING and integers have one.
// In: the uses of a body. Out: the measured strings; then, with the slices, where each length is known and where it is
// counted. Called by analysis.cpp; written by measured.cpp, strings.cpp and calls.cpp.
//
// Without it (tests/bench/run.sh kernels, --checks=none) `telegram` executes 5.7 times as many instructions (which
// includes the gain of slices.h), `report` 3.3 times.
#pragma once

#include "codegen/uses.h"

namespace rung::codegen {

struct MeasuredStrings {
  enum class As : uint8_t { No, Own, Shared };
  std::vector<As> as;  // by variable
  bool any = false;

  bool has(uint32_t variable) const { return variable != kNoVariable && as[variable] != As::No; }
  bool isShared(uint32_t variable) const { return variable != kNoVariable && as[variable] == As::Shared; }
  bool isOwn(uint32_t variable) const { return variable != kNoVariable && as[variable] == As::Own; }
  std::string toString(const Variables& variables) const;
};

MeasuredStrings analyzeLengths(const ir::Module& module, const ir::Body& body, const Facts& facts, const Uses& uses);

// Both the analysis of lengths and the writers ask this of the strings of a body.
struct StringsOfBody {
  const ir::Module& module;
  const ir::Body& body;
  const Variables& variables;
  const MeasuredStrings& measured;

  bool isMeasured(ir::ExprId place) const { return measured.any && measured.has(variables.stringAt(place)); }
  bool isOwn(ir::ExprId place) const { return measured.any && measured.isOwn(variables.stringAt(place)); }
  // `out` of a sized function must be one of its strings or overlap none: true when either side is measured and not
  // shared.
  bool isSizedCall(const ir::Body& callee, Slice<ir::ExprId> operands, ir::ExprId result) const;
  // True when the lengths of both sides are passed. `known`: whether that of a measured string is known there.
  template <class Known>
  bool isSizedComparison(const ir::BinaryExpr& node, Known&& known) const {
    if (node.op != types::Op::Eq && node.op != types::Op::Ne) return false;
    auto is_known = [&](ir::ExprId side) { return isMeasured(side) && known(side); };
    auto is_literal = [&](ir::ExprId side) { return body.expr(side).kind == ir::ExprKind::String; };
    const ir::ExprId a = node.left, b = node.right;
    return (is_known(a) && (is_known(b) || is_literal(b))) || (is_literal(a) && is_known(b));
  }
};

// The second form of a native: marked {sized}, and all its types are STRING or integers.
bool isSized(const ir::Module& module, const ir::Body& callee);

// The strings whose lengths are known at a point of a body; a block forgets at its end what became known in it.
class KnownStrings {
 public:
  explicit KnownStrings(uint32_t count) : is_known_(count) {}
  bool has(uint32_t variable) const { return is_known_[variable] != 0; }
  void set(uint32_t variable) {
    if (has(variable)) return;
    is_known_[variable] = 1;
    order_.push_back(variable);
  }
  void unset(uint32_t variable) { is_known_[variable] = 0; }
  size_t mark() const { return order_.size(); }
  void forget(size_t mark) {
    for (; order_.size() > mark; order_.pop_back()) is_known_[order_.back()] = 0;
  }

 private:
  std::vector<uint8_t> is_known_;
  std::vector<uint32_t> order_;
};

struct KnownLengths {
  std::vector<uint8_t> is_known;  // by expression: a measured string whose length is known there; empty without any
  std::vector<std::vector<ir::ExprId>> counted;  // by statement: the strings to count in front of it
  std::vector<uint8_t> forgets;  // by statement: shared strings that it does not write have an unknown length after it

  bool at(ir::ExprId place) const { return !is_known.empty() && is_known[place.index] != 0; }
  bool forgetsAfter(ir::StmtId stmt) const { return !forgets.empty() && forgets[stmt.index] != 0; }
  bool countsBefore(ir::StmtId stmt) const { return !counted.empty() && !counted[stmt.index].empty(); }
  std::string toString(const ir::Module& module, const ir::Body& body, const Variables& variables) const;
};

struct Slices;
KnownLengths analyzeKnownLengths(const StringsOfBody& strings, const Slices& slices, const Facts& facts);

}  // namespace rung::codegen
