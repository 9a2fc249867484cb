// SPDX-License-Identifier: Apache-2.0
// Makes the statements of a chart. In: the parts of expressions and statements. Out: nodes with the current location,
// which the scheduler moves through the chart as it goes, so that messages, faults and `#line` point into it.
// Statements are added to the list that is open. Private to frontend/schedule.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "frontend/syntax/clone.h"
#include "frontend/syntax/tree_builder.h"

namespace rung::text {

class SfcBuilder {
 public:
  SfcBuilder(Tree& tree, Names& names) : tree_(tree), names_(names) {}

  void at(Loc loc) { loc_ = loc; }

  // ---- expressions
  ExprId name(NameId name) { return build_.name(name, loc_); }
  ExprId name(std::string_view name) { return build_.name(names_.intern(name), loc_); }
  // `Turn`, or `motor.Turn`, an action of an instance.
  ExprId path(NameId name);
  ExprId member(ExprId base, std::string_view name) { return build_.member(base, names_.intern(name), loc_); }
  ExprId element(ExprId base, ExprId index) { return build_.index(base, tree_.addList<ExprId>({&index, 1}), loc_); }
  ExprId boolean(bool value) { return build_.boolean(value, loc_); }
  ExprId number(uint32_t value) { return build_.literal(LiteralKind::Integer, value, loc_); }
  ExprId text(std::string_view characters) { return build_.text(LiteralKind::String, characters, loc_); }
  ExprId noTime() { return build_.literal(LiteralKind::Duration, 0, loc_); }
  ExprId noBits() { return build_.literal(LiteralKind::Integer, 0, loc_, names_.intern("LWORD")); }
  ExprId bits(uint64_t word) {
    return build_.literal(LiteralKind::Integer, word, loc_, names_.intern("LWORD"), {.is_based = true});
  }
  ExprId negation(ExprId operand) { return build_.unary(UnaryOp::Not, operand, loc_); }
  ExprId binary(BinaryOp op, ExprId left, ExprId right) { return build_.binary(op, left, right, loc_); }
  // left AND right; `right` alone where there is no left operand yet.
  ExprId both(ExprId left, ExprId right) { return left ? binary(BinaryOp::And, left, right) : right; }
  ExprId call(ExprId callee, std::initializer_list<ExprId> arguments = {});
  ExprId call(std::string_view function, std::initializer_list<ExprId> arguments = {}) {
    return call(name(function), arguments);
  }
  // A copy of what the chart has there, with its own locations.
  ExprId quote(ExprId written) { return clone(tree_, written); }
  ExprId inParens(ExprId expr) {
    tree_.expr(expr).in_parens = 1;
    return expr;
  }

  // ---- statements
  void assign(ExprId target, ExprId value) { out_.push_back(build_.assign(AssignOp::Assign, target, value, loc_)); }
  void set(ExprId target, bool value) { assign(target, boolean(value)); }
  void callStatement(ExprId call) { out_.push_back(build_.callStatement(call)); }
  // block(pin := value);
  void callBlock(ExprId block, std::string_view pin, ExprId value);
  void leave() { out_.push_back(build_.returnStatement(loc_)); }
  // IF condition THEN what `body` adds END_IF
  template <class Body>
  void when(ExprId condition, Body body) {
    const Loc loc = loc_;
    const IfBranch branch{condition, list(body)};
    ifStatement({&branch, 1}, {}, loc);
  }
  void ifStatement(std::span<const IfBranch> branches, Slice<StmtId> otherwise, Loc loc) {
    out_.push_back(build_.ifStatement(tree_.addList<IfBranch>(branches), otherwise, loc));
  }
  template <class Body>
  void loopWhile(ExprId condition, Body body) {
    const Loc loc = loc_;
    out_.push_back(build_.whileStatement(condition, list(body), loc));
  }
  // FOR control := from TO to DO what `body` adds END_FOR
  template <class Body>
  void count(ExprId control, ExprId from, ExprId to, Body body) {
    const Loc loc = loc_;
    out_.push_back(build_.forStatement(control, from, to, list(body), loc));
  }
  void select(ExprId selector, std::span<const CaseBranch> branches) {
    out_.push_back(build_.caseStatement(selector, tree_.addList<CaseBranch>(branches), loc_));
  }
  Slice<ExprId> labels(ExprId label) { return tree_.addList<ExprId>({&label, 1}); }

  // The statements that `body` adds, as a list of their own.
  template <class Body>
  Slice<StmtId> list(Body body) {
    const size_t first = out_.size();
    body();
    const Slice<StmtId> made = tree_.addList<StmtId>(std::span<const StmtId>(out_).subspan(first));
    out_.resize(first);
    return made;
  }

 private:
  Tree& tree_;
  TreeBuilder build_{tree_};
  Names& names_;
  Loc loc_;
  std::vector<StmtId> out_;
};

}  // namespace rung::text
