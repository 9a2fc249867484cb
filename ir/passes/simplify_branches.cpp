// Branch and CASE simplification: see simplify_branches.h.
#include "ir/passes/simplify_branches.h"

#include "ir/passes/support.h"

namespace rung::ir {

namespace {

class Simplifier {
 public:
  Simplifier(Module& module, Body& body) : types_(module.types), body_(body) {}

  bool run() {
    if (!body_.first) return false;
    if (body_.has_labels) {
      jumps_.assign(body_.labels.size(), 0);
      forEachStmt(body_, body_.first, [&](StmtId id) {
        if (body_.stmt(id).kind == StmtKind::Jump) ++jumps_[body_.stmt(id).a];
      });
    }
    block(body_.first.index);
    if (body_.has_labels && labels_kept_ == 0) {
      body_.has_labels = false;
      body_.labels.clear();
    }
    return changed_;
  }

 private:
  const Expr& at(uint32_t id) const { return body_.exprs[id]; }

  // Simplifies the list that begins at `first`; whether control can leave its end.
  bool block(uint32_t& first) {
    bool reached = true;
    StmtId previous;
    for (uint32_t id = first; id != 0;) {
      // Found again in each iteration: `first` may be a field of a statement.
      auto relink = [&](uint32_t to) {
        (previous ? body_.stmt(previous).next.index : first) = to;
        id = to;
        changed_ = true;
      };
      Stmt& s = body_.stmts[id];
      if (!reached && s.kind != StmtKind::Label) {
        forget(s);
        relink(s.next.index);
        continue;
      }
      if (s.kind == StmtKind::Label) {
        if (jumps_[s.a] == 0) {
          relink(s.next.index);
          continue;
        }
        ++labels_kept_;
        reached = true;
      }
      if (s.kind == StmtKind::If && replaceIf(s)) {
        const uint32_t block_first = s.a != 0 ? s.b : s.c;  // replaceIf leaves 1 or 0 in a
        relink(splice(block_first, s.next.index));
        continue;
      }
      if (s.kind == StmtKind::Switch && isConst(at(s.a))) {
        relink(splice(taken(s), s.next.index));
        continue;
      }
      reached = stmt(s) && reached;
      // A statement whose blocks became empty.
      if (s.kind == StmtKind::If && s.b == 0 && s.c == 0) {
        dropTo(s);
        if (s.kind == StmtKind::None) {
          relink(s.next.index);
          continue;
        }
      } else if (s.kind == StmtKind::If && s.b == 0) {
        negate(s);
      } else if (s.kind == StmtKind::Loop && s.a != 0 && body_.stmts[s.a].kind == StmtKind::Break &&
                 !body_.stmts[s.a].next) {
        relink(s.next.index);  // WHILE FALSE
        continue;
      }
      previous = StmtId{id};
      id = s.next.index;
    }
    return reached;
  }

  // Whether control can reach what follows the statement.
  bool stmt(Stmt& s) {
    switch (s.kind) {
      case StmtKind::None:
      case StmtKind::Assign:
      case StmtKind::Bind:
      case StmtKind::Call:
      case StmtKind::Label:
      case StmtKind::Assert:
      case StmtKind::Evaluate: return true;
      case StmtKind::Break: breaks_ = true; return false;
      case StmtKind::Continue:
      case StmtKind::Return:
      case StmtKind::Jump:
      case StmtKind::Fault: return false;
      case StmtKind::If: {
        const bool yes = block(s.b);
        const bool no = block(s.c);
        return yes || no;
      }
      case StmtKind::Switch: {
        bool falls = false;
        for (uint32_t i = 0; i < s.c; ++i) falls = block(body_.cases[s.b + i].block.index) || falls;
        return block(s.d) || falls;
      }
      case StmtKind::Loop: {
        const bool outer = breaks_;
        breaks_ = false;
        block(s.a);
        block(s.b);
        const bool leaves = breaks_;
        breaks_ = outer;
        return leaves;
      }
      case StmtKind::For: {
        const bool outer = breaks_;
        block(s.e);
        breaks_ = outer;
        return true;
      }
      case StmtKind::Try: {
        const bool tried = block(s.a);
        const bool caught = block(s.b);
        return block(s.c) && (tried || caught);
      }
    }
    return true;
  }

  // The jumps of a removed statement no longer keep their labels.
  void forget(const Stmt& s) {
    if (jumps_.empty()) return;
    if (s.kind == StmtKind::Jump) --jumps_[s.a];
    forEachBlock(body_, s, [&](const uint32_t& inner) {
      for (uint32_t id = inner; id != 0; id = body_.stmts[id].next.index) forget(body_.stmts[id]);
    });
  }
  void forgetBlock(uint32_t first) {
    for (uint32_t id = first; id != 0; id = body_.stmts[id].next.index) forget(body_.stmts[id]);
  }

  // An `if` on a constant: leaves 1 or 0 in its condition slot.
  bool replaceIf(Stmt& s) {
    if (!isConst(at(s.a))) return false;
    const bool yes = at(s.a).bits() != 0;
    forgetBlock(yes ? s.c : s.b);
    s.a = yes;
    return true;
  }

  // The block that a constant selector takes.
  uint32_t taken(const Stmt& s) {
    const bool is_signed = types_.isSigned(types_.plainKind(at(s.a).type));
    const uint64_t value = at(s.a).bits();
    auto notAbove = [&](uint64_t a, uint64_t b) {
      return is_signed ? static_cast<int64_t>(a) <= static_cast<int64_t>(b) : a <= b;
    };
    uint32_t found = s.d;
    bool in_case = false;
    for (uint32_t i = 0; i < s.c; ++i) {
      const Case& one = body_.cases[s.b + i];
      bool hit = false;
      for (uint32_t k = 0; k < one.range_count && !in_case; ++k) {
        const CaseRange& range = body_.ranges[one.first_range + k];
        hit = hit ||
              (notAbove(static_cast<uint64_t>(range.low), value) && notAbove(value, static_cast<uint64_t>(range.high)));
      }
      if (hit) {
        found = one.block.index;
        in_case = true;
      } else {
        forgetBlock(one.block.index);
      }
    }
    if (in_case) forgetBlock(s.d);
    return found;
  }

  // Appends `rest` to the list at `first`; returns the joined list.
  uint32_t splice(uint32_t first, uint32_t rest) {
    if (first == 0) return rest;
    uint32_t last = first;
    while (body_.stmts[last].next) last = body_.stmts[last].next.index;
    body_.stmts[last].next.index = rest;
    return first;
  }

  // An `if` without branches: its condition is evaluated for its faults, or removed.
  void dropTo(Stmt& s) {
    const bool needed = mayFault(body_, ExprId{s.a});
    s.kind = needed ? StmtKind::Evaluate : StmtKind::None;
    changed_ = true;
  }

  // if c {} else {x}: if not c {x}
  void negate(Stmt& s) {
    Expr& condition = body_.exprs[s.a];
    if (condition.kind == ExprKind::Unary && condition.op == Op::Not) {
      s.a = condition.a;
    } else {
      Expr inverse;
      inverse.kind = ExprKind::Unary;
      inverse.op = Op::Not;
      inverse.type = types::kBool;
      inverse.loc = condition.loc;
      inverse.a = s.a;
      s.a = static_cast<uint32_t>(body_.exprs.size());
      body_.exprs.push_back(inverse);
    }
    s.b = s.c;
    s.c = 0;
    changed_ = true;
  }

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
