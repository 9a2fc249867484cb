// Lengths of strings in C++ locals. A string that nothing else can reach while the body runs and that sized functions
// use keeps its length beside it, so nothing counts its characters again: `s := CONCAT(s, c)` appends at the end, MID
// knows whether its position is inside. Every write of such a string sets its length. The length is counted before the
// first use in a block; a loop counts in front what it will need. Memory stays NUL-terminated after each statement.
// Sized functions are natives marked {sized}: their second form in rung/<library>.h takes the length after each string
// and returns the length of the result.
// In: the uses of a body. Out: the measured strings; then, with the slices, where each length is known and where it is
// counted. Called by analysis.cpp; written by measured.cpp, strings.cpp and calls.cpp.
//
// Without it (tests/bench/run.sh kernels, --checks=none) `telegram` executes 5.7 times as many instructions (which
// includes the gain of slices.h), `report` 3.3 times.
#pragma once

#include "codegen/uses.h"

namespace rung::codegen {

struct MeasuredStrings {
  std::vector<uint8_t> is_measured;  // by variable
  bool any = false;

  bool has(uint32_t variable) const { return variable != kNoVariable && is_measured[variable] != 0; }
  std::string toString(const Variables& variables) const;
};

MeasuredStrings analyzeLengths(const ir::Body& body, const Facts& facts, const Uses& uses);

// What is asked of the strings of a body while its lengths are analysed and while it is written.
struct StringsOfBody {
  const ir::Module& module;
  const ir::Body& body;
  const Variables& variables;
  const MeasuredStrings& measured;

  bool isMeasured(ir::ExprId place) const { return measured.any && measured.has(variables.stringAt(place)); }
  // `out` of a sized function must be one of its strings or overlap none: true when either side is measured.
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

// The second form of a native: marked {sized}, and all its strings are STRING.
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

  bool at(ir::ExprId place) const { return !is_known.empty() && is_known[place.index] != 0; }
  bool countsBefore(ir::StmtId stmt) const { return !counted.empty() && !counted[stmt.index].empty(); }
  std::string toString(const ir::Module& module, const ir::Body& body, const Variables& variables) const;
};

struct Slices;
KnownLengths analyzeKnownLengths(const StringsOfBody& strings, const Slices& slices);

}  // namespace rung::codegen
