// SPDX-License-Identifier: Apache-2.0
// Branch and CASE simplification: see simplify_branches.h.
#include "ir/passes/simplify_branches.h"

#include <utility>

#include "ir/passes/support.h"

namespace rung::ir {

namespace {

class Simplifier {
 public:
  Simplifier(Module& module, Body& body) : module_(module), types_(module.types), body_(body) {}

  bool run() {
    if (!body_.first) return false;
    if (body_.has_labels) {
      jumps_.assign(body_.labels.size(), 0);
      forEachStmt(body_, body_.first, [&](StmtId id) {
        if (const auto* jump = body_.stmt(id).tryAs<JumpStmt>()) ++jumps_[jump->label];
      });
    }
    block(body_.first);
    if (body_.has_labels && labels_kept_ == 0) {
      body_.has_labels = false;
      body_.labels.clear();
    }
    return changed_;
  }

 private:
  // Simplifies the list that begins at `first`; whether control can leave its end.
  bool block(StmtId& first) {
    bool reached = true;
    StmtId previous;
    for (StmtId id = first; id;) {
      // Found again in each iteration: `first` may be a field of a statement.
      auto relink = [&](StmtId to) {
        (previous ? body_.stmt(previous).next : first) = to;
        id = to;
        changed_ = true;
      };
      Stmt& s = body_.stmt(id);
      if (!reached && s.kind != StmtKind::Label) {
        forget(s);
        relink(s.next);
        continue;
      }
      if (const auto* label = s.tryAs<LabelStmt>()) {
        if (jumps_[label->label] == 0) {
          relink(s.next);
          continue;
        }
        ++labels_kept_;
        reached = true;
      }
      if (isDecided(s)) {
        relink(splice(taken(s), s.next));
        continue;
      }
      reached = stmt(s) && reached;
      if (isEmptied(s)) {
        relink(s.next);
        continue;
      }
      previous = id;
      id = s.next;
    }
    return reached;
  }

  // Tells whether a statement whose blocks became empty does nothing. An `if` that only has an else block is turned
  // round.
  bool isEmptied(Stmt& s) {
    if (s.kind == StmtKind::If) {
      const IfStmt& node = s.as<IfStmt>();
      if (node.then_block) return false;
      if (node.else_block) {
        negate(s.as<IfStmt>());
        return false;
      }
      changed_ = true;
      if (!mayFault(body_, node.condition)) return true;
      s.set(EvaluateStmt{ExprId{node.condition}});
      return false;
    }
    if (s.kind != StmtKind::Loop) return false;
    const StmtId first = s.as<LoopStmt>().body_block;  // WHILE FALSE
    return first && body_.stmt(first).kind == StmtKind::Break && !body_.stmt(first).next;
  }

  // Tells whether control can reach what follows the statement.
  bool stmt(Stmt& s) {
    if (s.kind == StmtKind::Break) breaks_ = true;
    if (flowOf(s.kind) != StmtFlow::Blocks) return flowOf(s.kind) == StmtFlow::Falls;
    if (s.kind == StmtKind::Try) {
      TryStmt& node = s.as<TryStmt>();
      const bool tried = block(node.body_block);
      const bool caught = block(node.catch_block);
      return block(node.finally_block) && (tried || caught);
    }
    const bool outer = breaks_, is_loop = s.kind == StmtKind::Loop || s.kind == StmtKind::For;
    if (is_loop) breaks_ = false;
    bool falls = false;
    forEachBlock(body_, s, [&](StmtId& first) { falls = block(first) || falls; });
    if (!is_loop) return falls;
    const bool leaves = std::exchange(breaks_, outer);
    return leaves || s.kind == StmtKind::For;  // a Loop is left by `break` alone
  }

  // The jumps of a removed statement no longer keep their labels.
  void forget(const Stmt& s) {
    if (jumps_.empty()) return;
    if (const auto* jump = s.tryAs<JumpStmt>()) --jumps_[jump->label];
    forEachBlock(body_, s, [&](StmtId inner) { forgetBlock(inner); });
  }
  void forgetBlock(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next) forget(body_.stmt(id));
  }

  // An `if` or a `switch` on a constant.
  bool isDecided(const Stmt& s) const {
    if (const auto* branch = s.tryAs<IfStmt>()) return isConst(body_.expr(branch->condition));
    if (const auto* branch = s.tryAs<SwitchStmt>()) return isConst(body_.expr(branch->selector));
    return false;
  }
  // The block that it takes; the others are forgotten.
  StmtId taken(const Stmt& s) {
    if (s.kind == StmtKind::Switch) return taken(s.as<SwitchStmt>());
    const IfStmt& node = s.as<IfStmt>();
    const bool yes = bitsOf(body_.expr(node.condition)) != 0;
    forgetBlock(yes ? node.else_block : node.then_block);
    return yes ? node.then_block : node.else_block;
  }
  StmtId taken(const SwitchStmt& s) {
    const Expr& selector = body_.expr(s.selector);
    const bool is_signed = types_.isSigned(types_.plainKind(selector.type));
    const uint64_t value = bitsOf(selector);
    auto notAbove = [&](uint64_t a, uint64_t b) {
      return is_signed ? static_cast<int64_t>(a) <= static_cast<int64_t>(b) : a <= b;
    };
    StmtId found = s.else_block;
    bool in_case = false;
    for (const Case& one : body_.list(s.cases)) {
      bool hit = false;
      for (const CaseRange& range : body_.list(one.ranges))
        hit = hit || (!in_case && notAbove(static_cast<uint64_t>(range.low), value) &&
                      notAbove(value, static_cast<uint64_t>(range.high)));
      if (hit) {
        found = one.block;
        in_case = true;
      } else {
        forgetBlock(one.block);
      }
    }
    if (in_case) forgetBlock(s.else_block);
    return found;
  }

  // Appends `rest` to the list at `first`; returns the joined list.
  StmtId splice(StmtId first, StmtId rest) {
    if (!first) return rest;
    StmtId last = first;
    while (body_.stmt(last).next) last = body_.stmt(last).next;
    body_.stmt(last).next = rest;
    return first;
  }

  // if c {} else {x}: if not c {x}
  void negate(IfStmt& s) {
    Builder builder(module_, body_);
    builder.loc = body_.expr(s.condition).loc;
    s = {.condition = builder.negation(s.condition), .then_block = s.else_block, .else_block = {}};
    changed_ = true;
  }

  Module& module_;
  const types::TypeTable& types_;
  Body& body_;
  std::vector<uint32_t> jumps_;  // by label
  uint32_t labels_kept_ = 0;
  bool breaks_ = false;
  bool changed_ = false;
};

}  // namespace

bool simplifyBranches(Module& module, Body& body) { return Simplifier(module, body).run(); }

}  // namespace rung::ir
