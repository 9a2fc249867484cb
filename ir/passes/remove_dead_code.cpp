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
      block(body_.first.index);
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
      if (s.kind == StmtKind::Call && (module_.body(BodyId{s.a}).pure || s.e != 0)) return true;
      if (s.kind != StmtKind::Assign) continue;
      const Expr& root = body_.expr(rootOf(body_, ExprId{s.a}));
      if (root.kind == ExprKind::Local && body_.locals[root.a].kind != LocalKind::Result) return true;
    }
    return false;
  }

  // Reads of each local by statements in the tree. A write to all or a part of the local does not count.
  void count() {
    reads_.assign(body_.locals.size(), 0);
    forEachStmt(body_, body_.first, [&](StmtId id) {
      const Stmt& s = body_.stmt(id);
      const bool writes_only = s.kind == StmtKind::Assign || s.kind == StmtKind::Call;
      forEachRoot(module_, body_, s, [&](const uint32_t& slot, Use use) {
        if (use == Use::Write && writes_only)
          countPlace(ExprId{slot});
        else
          countReads(ExprId{slot});
      });
    });
  }
  void countReads(ExprId id) {
    const Expr& e = body_.expr(id);
    if (e.kind == ExprKind::Local) ++reads_[e.a];
    forEachSlot(body_, e, [&](const uint32_t& slot) { countReads(ExprId{slot}); });
  }
  // Indices in a written place are read, its root is not.
  void countPlace(ExprId id) {
    const Expr& e = body_.expr(id);
    if (e.kind == ExprKind::Local) return;
    if (e.kind != ExprKind::Field && e.kind != ExprKind::Index && e.kind != ExprKind::Bits) return countReads(id);
    countPlace(ExprId{e.a});
    if (e.kind == ExprKind::Index)
      for (uint32_t i = 0; i < e.c; ++i) countReads(body_.operands[e.b + i]);
  }

  // A place in a local of this call that nothing reads.
  bool isUnread(uint32_t place) const {
    const Expr& root = body_.expr(rootOf(body_, ExprId{place}));
    if (root.kind != ExprKind::Local) return false;
    const Local& local = body_.locals[root.a];
    // A by-reference field on the way leads out of the local; a Temp never holds one.
    const bool own =
        local.kind == LocalKind::Temp || local.kind == LocalKind::Variable || local.kind == LocalKind::Input;
    return own && !local.by_reference && reads_[root.a] == 0 && !leadsOut(place);
  }
  bool leadsOut(uint32_t place) const {
    for (uint32_t id = place;;) {
      const Expr& e = body_.exprs[id];
      if (e.kind != ExprKind::Field && e.kind != ExprKind::Index && e.kind != ExprKind::Bits) return false;
      if (e.kind == ExprKind::Field &&
          module_.types.info(module_.types.resolve(body_.exprs[e.a].type)).fields[e.b].by_reference)
        return true;
      id = e.a;
    }
  }

  void block(uint32_t& first) {
    uint32_t* link = &first;
    while (*link != 0) {
      Stmt& s = body_.stmts[*link];
      forEachBlock(body_, s, [&](uint32_t& inner) { block(inner); });
      if (isDead(s)) {
        *link = s.next.index;
        changed_ = true;
      } else {
        link = &s.next.index;
      }
    }
  }

  bool isDead(Stmt& s) {
    switch (s.kind) {
      case StmtKind::Evaluate: return !mayFault(body_, ExprId{s.a});
      case StmtKind::Assign:
        if (!isUnread(s.a) || mayFault(body_, ExprId{s.a})) return false;
        if (!mayFault(body_, ExprId{s.b})) return true;
        s.kind = StmtKind::Evaluate;
        s.a = s.b;
        s.b = 0;
        changed_ = true;
        return false;
      case StmtKind::Call: {
        if (s.e != 0 && isUnread(s.e) && !mayFault(body_, ExprId{s.e})) {
          s.e = 0;
          changed_ = true;
        }
        const Body& callee = module_.body(BodyId{s.a});
        if (!callee.pure || s.e != 0) return false;
        bool needed = callee.may_fault;
        forEachRoot(module_, body_, s, [&](uint32_t& slot, Use use) {
          needed = needed || use != Use::Read || mayFault(body_, ExprId{slot});
        });
        return !needed;
      }
      case StmtKind::None:
      case StmtKind::Bind:
      case StmtKind::If:
      case StmtKind::Switch:
      case StmtKind::Loop:
      case StmtKind::For:
      case StmtKind::Break:
      case StmtKind::Continue:
      case StmtKind::Return:
      case StmtKind::Jump:
      case StmtKind::Label:
      case StmtKind::Try:
      case StmtKind::Fault:
      case StmtKind::Assert: return false;
    }
    return false;
  }

  Module& module_;
  Body& body_;
  std::vector<uint32_t> reads_;  // by local
  bool changed_ = false;
};

}  // namespace

bool removeDeadCode(Module& module, Body& body) { return Remover(module, body).run(); }

}  // namespace rung::ir
