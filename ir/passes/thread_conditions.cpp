// SPDX-License-Identifier: Apache-2.0
// Conditions: see thread_conditions.h. Lowering makes of `IF a AND b THEN …`
//   t = a   if t { …; t = b }   if t { … } else { … }
// and of a longer AND one more `if` in the middle for each operand; of OR the same with `if not t`.
#include "ir/passes/thread_conditions.h"

#include "ir/passes/support.h"

namespace rung::ir {

namespace {

class Threader {
 public:
  Threader(Module& module, Body& body) : module_(module), body_(body) {}

  bool run() {
    if (body_.has_labels || !body_.first || !isWorthIt()) return false;
    count();
    body_.first = block(body_.first);
    return changed_;
  }

 private:
  struct Test {  // of an `if`
    uint32_t local = 0;
    bool is_found = false, negated = false;
  };

  // An `if` on a temporary, negated or not.
  Test testOf(StmtId id) const {
    const auto* branch = id ? body_.stmt(id).tryAs<IfStmt>() : nullptr;
    if (branch == nullptr) return {};
    const Expr* condition = &body_.expr(branch->condition);
    const bool negated = isNot(*condition);
    if (negated) condition = &body_.expr(condition->as<UnaryExpr>().operand);
    const uint32_t* local = localOf(*condition);
    if (local == nullptr || body_.locals[*local].kind != LocalKind::Temp) return {};
    return {*local, true, negated};
  }
  bool isWorthIt() const {
    for (uint32_t id = 1; id < body_.stmts.size(); ++id)
      if (testOf(StmtId{id}).is_found) return true;
    return false;
  }

  bool assigns(StmtId id, uint32_t local) const {
    const auto* assign = body_.stmt(id).tryAs<AssignStmt>();
    const uint32_t* place = assign == nullptr ? nullptr : localOf(body_.expr(assign->place));
    return place != nullptr && *place == local;
  }

  // Uses of each local, its assignments not counted.
  void count() {
    reads_.assign(body_.locals.size(), 0);
    forEachStmt(body_, body_.first, [&](StmtId id) {
      const Stmt& s = body_.stmt(id);
      forEachRoot(module_, body_, s, [&](ExprId root, Use use) {
        if (use == Use::Write && s.kind == StmtKind::Assign && localOf(body_.expr(root)) != nullptr) return;
        forEachExpr(body_, root, [&](ExprId e) {
          if (const uint32_t* local = localOf(body_.expr(e))) ++reads_[*local];
        });
      });
    });
  }

  StmtId lastOf(StmtId first) const {
    while (first && body_.stmt(first).next) first = body_.stmt(first).next;
    return first;
  }
  bool onlyLeaves(StmtId first) const {
    if (!first || body_.stmt(first).next) return false;
    const StmtKind kind = body_.stmt(first).kind;
    return kind == StmtKind::Break || kind == StmtKind::Continue || kind == StmtKind::Return;
  }
  ExprId negation(ExprId condition) {
    Builder builder(module_, body_);
    builder.loc = body_.expr(condition).loc;
    return builder.negation(condition);
  }

  // The list that begins at `first`; returns its new beginning. The vector of statements may grow.
  StmtId block(StmtId first) {
    for (StmtId id = first, previous; id;) {
      const StmtId now = thread(id);
      if (now != id) {
        (previous ? body_.stmt(previous).next : first) = now;
        changed_ = true;
        id = now;
        continue;
      }
      Stmt s = body_.stmt(id);
      forEachBlock(body_, s, [&](StmtId& inner) { inner = block(inner); });
      body_.stmt(id) = s;
      previous = id;
      id = s.next;
    }
    return first;
  }

  // Threads the condition that begins at `id`; returns the statement that begins it now.
  StmtId thread(StmtId id) {
    const StmtId second = body_.stmt(id).next;
    const Test test = testOf(second);
    if (!test.is_found || !assigns(id, test.local)) return id;
    const ExprId value = body_.stmt(id).as<AssignStmt>().value;
    if (reads_[test.local] == 1) {
      ExprId& condition = body_.stmt(second).as<IfStmt>().condition;
      (test.negated ? body_.expr(condition).as<UnaryExpr>().operand : condition) = value;
      return second;
    }

    uint32_t reads = 1;
    StmtId last = second;
    while (isLink(last, test)) {
      last = body_.stmt(last).next;
      ++reads;
    }
    const Test asked = testOf(last);
    if (last == second || !asked.is_found || asked.local != test.local || reads_[test.local] != reads) return id;

    // The branch that runs when the left operand alone decides.
    const IfStmt& branch = body_.stmt(last).as<IfStmt>();
    const StmtId decided = asked.negated == test.negated ? branch.else_block : branch.then_block;
    const ExprId condition = test.negated ? negation(value) : value;
    const StmtId inner = body_.stmt(second).as<IfStmt>().then_block, rest = body_.stmt(second).next;
    if (!decided) {  // the rest moves into the branch
      body_.stmt(lastOf(inner)).next = rest;
      body_.stmt(second).next = body_.stmt(last).next;
      body_.stmt(last).next = {};
      body_.stmt(second).as<IfStmt>().condition = condition;
    } else if (onlyLeaves(decided)) {
      const Stmt leave = body_.stmt(decided);
      body_.stmts.push_back(leave);
      const StmtId own_leave{static_cast<uint32_t>(body_.stmts.size() - 1)};
      body_.stmt(lastOf(inner)).next = rest;
      body_.stmt(second).next = inner;
      body_.stmt(second).as<IfStmt>().then_block = own_leave;
      body_.stmt(second).as<IfStmt>().condition = negation(condition);
    } else {
      return id;
    }
    --reads_[test.local];
    return second;
  }

  // The `if` of one more operand: its block ends with the temporary's new value.
  bool isLink(StmtId id, const Test& test) const {
    const Test own = testOf(id);
    if (!own.is_found || own.local != test.local || own.negated != test.negated) return false;
    const Stmt& s = body_.stmt(id);
    const IfStmt& branch = s.as<IfStmt>();
    return !branch.else_block && branch.then_block && s.next && assigns(lastOf(branch.then_block), test.local);
  }

  Module& module_;
  Body& body_;
  std::vector<uint32_t> reads_;  // by local
  bool changed_ = false;
};

}  // namespace

bool threadConditions(Module& module, Body& body) { return Threader(module, body).run(); }

}  // namespace rung::ir
