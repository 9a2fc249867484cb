// Propagation: see propagate.h. An array holds what is known of each local; changes go to a trail, so that the end of a
// branch takes them back and knows what the branch assigned.
#include "ir/passes/propagate.h"

#include "ir/passes/support.h"

namespace rung::ir {

using types::TypeTable;

namespace {

struct Known {
  enum class Kind : uint8_t { Nothing, Constant, Copy } kind = Kind::Nothing;
  uint32_t of = 0;  // Copy: the local, and its version then
  uint32_t version = 0;
  uint64_t bits = 0;  // Constant
};

class Propagator {
 public:
  Propagator(Module& module, Body& body) : module_(module), types_(module.types), body_(body) {}

  bool run() {
    if (body_.has_labels || !body_.first || !isWorthIt()) return false;
    private_ = privateLocals(module_, body_);
    known_.assign(body_.locals.size(), {});
    version_.assign(body_.locals.size(), 0);
    stamp_.assign(body_.locals.size(), 0);
    block(body_.first);
    return changed_;
  }

 private:
  bool isWorthIt() const {
    for (const Stmt& s : body_.stmts) {
      if (s.kind != StmtKind::Assign || body_.exprs[s.a].kind != ExprKind::Local) continue;
      const ExprKind value = body_.exprs[s.b].kind;
      if (value == ExprKind::Const || value == ExprKind::Local) return true;
    }
    return false;
  }

  void set(uint32_t local, const Known& known) {
    trail_.push_back({local, known_[local]});
    known_[local] = known;
    version_[local] = ++versions_;
  }
  void forget(ExprId place) {
    const Expr& root = body_.expr(rootOf(body_, place));
    if (root.kind == ExprKind::Local && private_[root.a]) set(root.a, {});
  }
  void forgetWrittenIn(StmtId first) {
    forEachStmt(body_, first, [&](StmtId id) {
      forEachWritten(module_, body_, body_.stmt(id), [&](ExprId place) { forget(place); });
    });
  }

  void block(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next) stmt(body_.stmt(id));
  }
  // A block that may or may not run: afterwards what it assigned is remembered in touched_.
  void branch(StmtId first) {
    const size_t mark = trail_.size();
    block(first);
    while (trail_.size() > mark) {
      touched_.push_back(trail_.back().local);
      known_[trail_.back().local] = trail_.back().before;
      trail_.pop_back();
    }
  }
  void forgetTouched(size_t mark) {
    const uint32_t now = ++stamps_;
    for (size_t i = mark; i < touched_.size(); ++i) {
      if (stamp_[touched_[i]] == now) continue;
      stamp_[touched_[i]] = now;
      set(touched_[i], {});
    }
    touched_.resize(mark);
  }

  // ---- reads

  void read(uint32_t& slot) {
    Expr& e = body_.exprs[slot];
    if (e.kind == ExprKind::Local) return replace(e);
    if (e.kind == ExprKind::Field || e.kind == ExprKind::Index || e.kind == ExprKind::Bits) return readInPlace(slot);
    if (e.kind == ExprKind::Address) return readInPlace(e.a);
    forEachSlot(body_, e, [&](uint32_t& below) { read(below); });
  }
  // The indices and pointers in a place; its root stays a place.
  void readInPlace(uint32_t& slot) {
    Expr& e = body_.exprs[slot];
    if (e.kind == ExprKind::Local) return;
    if (e.kind == ExprKind::Field || e.kind == ExprKind::Index || e.kind == ExprKind::Bits) {
      readInPlace(e.a);
      if (e.kind == ExprKind::Index)
        for (uint32_t i = 0; i < e.c; ++i) read(body_.operands[e.b + i].index);
      return;
    }
    forEachSlot(body_, e, [&](uint32_t& below) { read(below); });
  }
  void replace(Expr& e) {
    const Known& known = known_[e.a];
    if (known.kind == Known::Kind::Constant) {
      becomeConst(e, e.type, known.bits);
      changed_ = true;
    } else if (known.kind == Known::Kind::Copy && version_[known.of] == known.version) {
      e.a = known.of;
      changed_ = true;
    }
  }

  // ---- statements

  void stmt(Stmt& s) {
    switch (s.kind) {
      case StmtKind::None:
      case StmtKind::Break:
      case StmtKind::Continue:
      case StmtKind::Return:
      case StmtKind::Jump:
      case StmtKind::Label: return;
      case StmtKind::Assign: return assign(s);
      case StmtKind::Bind:
      case StmtKind::Call:
      case StmtKind::Fault:
      case StmtKind::Assert:
      case StmtKind::Evaluate:
        forEachRoot(module_, body_, s,
                    [&](uint32_t& slot, Use use) { use == Use::Read ? read(slot) : readInPlace(slot); });
        forEachWritten(module_, body_, s, [&](ExprId place) { forget(place); });
        return;
      case StmtKind::If: {
        read(s.a);
        const size_t mark = touched_.size();
        branch(StmtId{s.b});
        branch(StmtId{s.c});
        forgetTouched(mark);
        return;
      }
      case StmtKind::Switch: {
        read(s.a);
        const size_t mark = touched_.size();
        for (uint32_t i = 0; i < s.c; ++i) branch(body_.cases[s.b + i].block);
        branch(StmtId{s.d});
        forgetTouched(mark);
        return;
      }
      case StmtKind::Loop: {
        forgetWrittenIn(StmtId{s.a});
        forgetWrittenIn(StmtId{s.b});
        const size_t mark = touched_.size();
        branch(StmtId{s.a});
        branch(StmtId{s.b});
        forgetTouched(mark);
        return;
      }
      case StmtKind::For: {
        readInPlace(s.a);
        read(s.b);
        read(s.c);
        forgetWrittenIn(StmtId{s.e});
        forget(ExprId{s.a});
        const size_t mark = touched_.size();
        branch(StmtId{s.e});
        forgetTouched(mark);
        return;
      }
      case StmtKind::Try: {
        const size_t mark = touched_.size();
        for (uint32_t part : {s.a, s.b, s.c}) {  // each may begin anywhere in the one before
          if (part == s.b && s.d != 0) forget(ExprId{s.d});
          branch(StmtId{part});
          forgetTouched(mark);
        }
        if (s.d != 0) forget(ExprId{s.d});
        return;
      }
    }
  }

  void assign(Stmt& s) {
    readInPlace(s.a);
    read(s.b);
    const Expr& place = body_.exprs[s.a];
    if (place.kind != ExprKind::Local || !private_[place.a]) return forget(ExprId{s.a});
    const Expr& value = body_.exprs[s.b];
    Known known;
    if (value.kind == ExprKind::Const && TypeTable::isScalar(types_.plainKind(place.type))) {
      known.kind = Known::Kind::Constant;
      known.bits = value.bits();
    } else if (value.kind == ExprKind::Local && private_[value.a] && value.a != place.a && value.type == place.type) {
      known.kind = Known::Kind::Copy;
      known.of = value.a;
      known.version = version_[value.a];
    }
    set(place.a, known);
  }

  struct Change {
    uint32_t local;
    Known before;
  };
  Module& module_;
  const TypeTable& types_;
  Body& body_;
  std::vector<bool> private_;
  std::vector<Known> known_;       // by local
  std::vector<uint32_t> version_;  // by local: grows with each assignment
  std::vector<uint32_t> stamp_;    // by local
  std::vector<Change> trail_;
  std::vector<uint32_t> touched_;
  uint32_t versions_ = 0, stamps_ = 0;
  bool changed_ = false;
};

}  // namespace

bool propagate(Module& module, Body& body) { return Propagator(module, body).run(); }

}  // namespace rung::ir
