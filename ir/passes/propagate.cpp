// SPDX-License-Identifier: Apache-2.0
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
      const auto* assign = s.tryAs<AssignStmt>();
      if (assign == nullptr || body_.expr(assign->place).kind != ExprKind::Local) continue;
      const ExprKind value = body_.expr(assign->value).kind;
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
    const uint32_t* local = localOf(body_.expr(rootOf(body_, place)));
    if (local != nullptr && private_[*local]) set(*local, {});
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

  void read(ExprId id) {
    Expr& e = body_.expr(id);
    if (e.kind == ExprKind::Local) return replace(e);
    if (baseOf(e)) return readInPlace(id);
    if (const auto* address = e.tryAs<AddressExpr>()) return readInPlace(address->place);
    forEachOperand(body_, e, [&](ExprId below) { read(below); });
  }
  // The indices and pointers in a place; its root stays a place.
  void readInPlace(ExprId place) {
    const Expr& e = body_.expr(place);
    if (e.kind == ExprKind::Local) return;
    const ExprId base = baseOf(e);
    forEachOperand(body_, e, [&](ExprId below) { below == base ? readInPlace(below) : read(below); });
  }
  void replace(Expr& e) {
    const Known& known = known_[e.as<LocalExpr>().local];
    if (known.kind == Known::Kind::Constant) {
      becomeConst(e, e.type, known.bits);
      changed_ = true;
    } else if (known.kind == Known::Kind::Copy && version_[known.of] == known.version) {
      e.as<LocalExpr>().local = known.of;
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
      case StmtKind::Assign: return assign(s.as<AssignStmt>());
      case StmtKind::Bind:
      case StmtKind::Call:
      case StmtKind::Fault:
      case StmtKind::Assert:
      case StmtKind::Evaluate:
        forEachRoot(module_, body_, s,
                    [&](ExprId root, Use use) { use == Use::Read ? read(root) : readInPlace(root); });
        forEachWritten(module_, body_, s, [&](ExprId place) { forget(place); });
        return;
      case StmtKind::If: read(s.as<IfStmt>().condition); return branches(s);
      case StmtKind::Switch: read(s.as<SwitchStmt>().selector); return branches(s);
      case StmtKind::Loop: forEachBlock(body_, s, [&](StmtId block) { forgetWrittenIn(block); }); return branches(s);
      case StmtKind::For: {
        const ForStmt& node = s.as<ForStmt>();
        readInPlace(node.control);
        read(node.from);
        read(node.to);
        forgetWrittenIn(node.body_block);
        forget(node.control);
        return branches(s);
      }
      case StmtKind::Try: return tryStmt(s.as<TryStmt>());
    }
  }
  // The blocks of a statement, each of which may run or not.
  void branches(const Stmt& s) {
    const size_t mark = touched_.size();
    forEachBlock(body_, s, [&](StmtId block) { branch(block); });
    forgetTouched(mark);
  }
  void tryStmt(const TryStmt& s) {
    const size_t mark = touched_.size();
    for (const StmtId part : {s.body_block, s.catch_block, s.finally_block}) {  // begins anywhere in the one before
      if (part == s.catch_block && s.number) forget(s.number);
      branch(part);
      forgetTouched(mark);
    }
    if (s.number) forget(s.number);
  }

  void assign(const AssignStmt& s) {
    readInPlace(s.place);
    read(s.value);
    const Expr& place = body_.expr(s.place);
    const uint32_t* to = localOf(place);
    if (to == nullptr || !private_[*to]) return forget(s.place);
    const Expr& value = body_.expr(s.value);
    const uint32_t* from = localOf(value);
    Known known;
    if (isConst(value) && TypeTable::isScalar(types_.plainKind(place.type))) {
      known.kind = Known::Kind::Constant;
      known.bits = bitsOf(value);
    } else if (from != nullptr && private_[*from] && *from != *to && value.type == place.type) {
      known.kind = Known::Kind::Copy;
      known.of = *from;
      known.version = version_[*from];
    }
    set(*to, known);
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
