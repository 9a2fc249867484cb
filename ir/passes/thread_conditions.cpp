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
    body_.first.index = block(body_.first.index);
    return changed_;
  }

 private:
  struct Test {  // of an `if`
    uint32_t local = 0;
    bool is_found = false, negated = false;
  };

  // An `if` on a temporary, negated or not.
  Test testOf(uint32_t id) const {
    if (id == 0 || body_.stmts[id].kind != StmtKind::If) return {};
    const Expr* e = &body_.exprs[body_.stmts[id].a];
    const bool negated = e->kind == ExprKind::Unary && e->op == Op::Not;
    if (negated) e = &body_.exprs[e->a];
    if (e->kind != ExprKind::Local || body_.locals[e->a].kind != LocalKind::Temp) return {};
    return {e->a, true, negated};
  }
  bool isWorthIt() const {
    for (uint32_t id = 1; id < body_.stmts.size(); ++id)
      if (testOf(id).is_found) return true;
    return false;
  }

  bool assigns(uint32_t id, uint32_t local) const {
    const Stmt& s = body_.stmts[id];
    return s.kind == StmtKind::Assign && body_.exprs[s.a].kind == ExprKind::Local && body_.exprs[s.a].a == local;
  }

  // Uses of each local, its assignments not counted.
  void count() {
    reads_.assign(body_.locals.size(), 0);
    forEachStmt(body_, body_.first, [&](StmtId id) {
      const Stmt& s = body_.stmt(id);
      forEachRoot(module_, body_, s, [&](const uint32_t& slot, Use use) {
        if (use == Use::Write && s.kind == StmtKind::Assign && body_.exprs[slot].kind == ExprKind::Local) return;
        forEachExpr(body_, ExprId{slot}, [&](ExprId e) {
          if (body_.expr(e).kind == ExprKind::Local) ++reads_[body_.expr(e).a];
        });
      });
    });
  }

  uint32_t lastOf(uint32_t first) const {
    while (first != 0 && body_.stmts[first].next) first = body_.stmts[first].next.index;
    return first;
  }
  bool onlyLeaves(uint32_t first) const {
    if (first == 0 || body_.stmts[first].next) return false;
    const StmtKind kind = body_.stmts[first].kind;
    return kind == StmtKind::Break || kind == StmtKind::Continue || kind == StmtKind::Return;
  }
  uint32_t negation(uint32_t condition) {
    Builder builder(module_, body_);
    builder.loc = body_.exprs[condition].loc;
    return builder.negation(ExprId{condition}).index;
  }

  // The list that begins at `first`; returns its new beginning. The vector of statements may grow.
  uint32_t block(uint32_t first) {
    for (uint32_t id = first, previous = 0; id != 0;) {
      const uint32_t now = thread(id);
      if (now != id) {
        (previous != 0 ? body_.stmts[previous].next.index : first) = now;
        changed_ = true;
        id = now;
        continue;
      }
      Stmt s = body_.stmts[id];
      forEachBlock(body_, s, [&](uint32_t& inner) { inner = block(inner); });
      body_.stmts[id] = s;
      previous = id;
      id = s.next.index;
    }
    return first;
  }

  // Threads the condition that begins at `id`; returns the statement that begins it now.
  uint32_t thread(uint32_t id) {
    const Stmt start = body_.stmts[id];
    const uint32_t second = start.next.index;
    const Test test = testOf(second);
    if (!test.is_found || !assigns(id, test.local)) return id;
    if (reads_[test.local] == 1) {
      Stmt& branch = body_.stmts[second];
      (test.negated ? body_.exprs[branch.a].a : branch.a) = start.b;
      return second;
    }

    uint32_t reads = 1, last = second;
    while (isLink(last, test)) {
      last = body_.stmts[last].next.index;
      ++reads;
    }
    const Test asked = testOf(last);
    if (last == second || !asked.is_found || asked.local != test.local || reads_[test.local] != reads) return id;

    // The branch that runs when the left operand alone decides.
    const Stmt& branch = body_.stmts[last];
    const uint32_t decided = asked.negated == test.negated ? branch.c : branch.b;
    const uint32_t condition = test.negated ? negation(start.b) : start.b;
    const uint32_t inner = body_.stmts[second].b, rest = body_.stmts[second].next.index;
    if (decided == 0) {  // the rest moves into the branch
      body_.stmts[lastOf(inner)].next.index = rest;
      body_.stmts[second].next = body_.stmts[last].next;
      body_.stmts[last].next = {};
      body_.stmts[second].a = condition;
    } else if (onlyLeaves(decided)) {
      const Stmt leave = body_.stmts[decided];
      body_.stmts.push_back(leave);
      body_.stmts[lastOf(inner)].next.index = rest;
      body_.stmts[second].next.index = inner;
      body_.stmts[second].b = static_cast<uint32_t>(body_.stmts.size() - 1);
      body_.stmts[second].a = negation(condition);
    } else {
      return id;
    }
    --reads_[test.local];
    return second;
  }

  // The `if` of one more operand: its block ends with the temporary's new value.
  bool isLink(uint32_t id, const Test& test) const {
    const Test own = testOf(id);
    if (!own.is_found || own.local != test.local || own.negated != test.negated) return false;
    const Stmt& s = body_.stmts[id];
    return s.c == 0 && s.b != 0 && s.next && assigns(lastOf(s.b), test.local);
  }

  Module& module_;
  Body& body_;
  std::vector<uint32_t> reads_;  // by local
  bool changed_ = false;
};

}  // namespace

bool threadConditions(Module& module, Body& body) { return Threader(module, body).run(); }

}  // namespace rung::ir
