// SPDX-License-Identifier: Apache-2.0
// Dead code: see remove_dead_code.h.
#include "ir/passes/remove_dead_code.h"

#include "ir/passes/support.h"

namespace rung::ir {

namespace {

class Remover {
 public:
  Remover(Module& module, Body& body) : module_(module), body_(body) {}

  bool run() {
    if (!body_.first || !isWorthIt()) return false;
    bool changed = false;
    for (int round = 0; round < 3; ++round) {  // a removed assignment may have been the last reader of another local
      changed_ = false;
      count();
      block(body_.first);
      if (!changed_) break;
      changed = true;
    }
    return changed;
  }

 private:
  // Something may be dead: a local of the call is assigned, a value evaluated for its checks, a pure function called.
  bool isWorthIt() const {
    for (const Stmt& s : body_.stmts) {
      if (s.kind == StmtKind::Evaluate) return true;
      if (const auto* call = s.tryAs<CallStmt>(); call != nullptr && (module_.body(call->callee).pure || call->result))
        return true;
      const auto* assign = s.tryAs<AssignStmt>();
      if (assign == nullptr) continue;
      const uint32_t* local = localOf(body_.expr(rootOf(body_, assign->place)));
      if (local != nullptr && body_.locals[*local].kind != LocalKind::Result) return true;
    }
    return false;
  }

  // Reads of each local by statements in the tree. A write to all or a part of the local does not count.
  void count() {
    reads_.assign(body_.locals.size(), 0);
    forEachStmt(body_, body_.first, [&](StmtId id) {
      const Stmt& s = body_.stmt(id);
      const bool writes_only = s.kind == StmtKind::Assign || s.kind == StmtKind::Call;
      forEachRoot(module_, body_, s, [&](ExprId root, Use use) {
        if (use == Use::Write && writes_only)
          countPlace(root);
        else
          countReads(root);
      });
    });
  }
  void countReads(ExprId id) {
    const Expr& e = body_.expr(id);
    if (const uint32_t* local = localOf(e)) ++reads_[*local];
    forEachOperand(body_, e, [&](ExprId operand) { countReads(operand); });
  }
  // Indices in a written place are read, its root is not.
  void countPlace(ExprId id) {
    const Expr& e = body_.expr(id);
    if (e.kind == ExprKind::Local) return;
    const ExprId base = baseOf(e);
    if (!base) return countReads(id);
    forEachOperand(body_, e, [&](ExprId operand) { operand == base ? countPlace(operand) : countReads(operand); });
  }

  // A place in a local of this call that nothing reads.
  bool isUnread(ExprId place) const {
    const uint32_t* root = localOf(body_.expr(rootOf(body_, place)));
    if (root == nullptr) return false;
    const Local& local = body_.locals[*root];
    // A by-reference field on the way leads out of the local; a Temp never holds one.
    const bool own =
        local.kind == LocalKind::Temp || local.kind == LocalKind::Variable || local.kind == LocalKind::Input;
    return own && !local.by_reference && reads_[*root] == 0 && !leadsOut(place);
  }
  bool leadsOut(ExprId place) const {
    for (; place; place = baseOf(body_.expr(place)))
      if (isReference(module_, body_, body_.expr(place))) return true;
    return false;
  }

  void block(StmtId& first) {
    StmtId* link = &first;
    while (*link) {
      Stmt& s = body_.stmt(*link);
      forEachBlock(body_, s, [&](StmtId& inner) { block(inner); });
      if (isDead(s)) {
        *link = s.next;
        changed_ = true;
      } else {
        link = &s.next;
      }
    }
  }

  bool isDead(Stmt& s) {
    if (const auto* evaluate = s.tryAs<EvaluateStmt>()) return !mayFault(body_, evaluate->value);
    if (const auto* assign = s.tryAs<AssignStmt>()) {
      const auto [place, value] = *assign;
      if (!isUnread(place) || mayFault(body_, place)) return false;
      if (!mayFault(body_, value)) return true;
      s.set(EvaluateStmt{value});
      changed_ = true;
      return false;
    }
    if (s.kind != StmtKind::Call) return false;
    CallStmt& call = s.as<CallStmt>();
    if (call.result && isUnread(call.result) && !mayFault(body_, call.result)) {
      call.result = {};
      changed_ = true;
    }
    const Body& callee = module_.body(call.callee);
    if (!callee.pure || call.result) return false;
    bool needed = callee.may_fault;
    forEachRoot(module_, body_, s,
                [&](ExprId root, Use use) { needed = needed || use != Use::Read || mayFault(body_, root); });
    return !needed;
  }

  Module& module_;
  Body& body_;
  std::vector<uint32_t> reads_;  // by local
  bool changed_ = false;
};

}  // namespace

bool removeDeadCode(Module& module, Body& body) { return Remover(module, body).run(); }

}  // namespace rung::ir
