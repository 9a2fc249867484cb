// SPDX-License-Identifier: Apache-2.0
// Privatization: see privatize.h.
#include "ir/passes/privatize.h"

#include "ir/passes/support.h"

namespace rung::ir {

using types::TypeTable;

namespace {

class Privatizer {
 public:
  Privatizer(Module& module, Body& body) : module_(module), types_(module.types), body_(body) {}

  bool run() {
    if (body_.has_labels || !body_.first) return false;
    block(body_.first);
    return changed_;
  }

 private:
  // A scalar of this body: a local, or a field of the instance.
  struct Scalar {
    ExprKind kind = ExprKind::None;
    uint32_t index = 0;
    explicit operator bool() const { return kind != ExprKind::None; }
    friend bool operator==(const Scalar&, const Scalar&) = default;
  };
  Scalar scalarAt(ExprId id) const {
    const Expr& e = body_.expr(id);
    if (!TypeTable::isScalar(types_.plainKind(e.type))) return {};
    if (const uint32_t* local = localOf(e); local != nullptr && !body_.locals[*local].by_reference)
      return {e.kind, *local};
    const auto* field = e.tryAs<FieldExpr>();
    if (field != nullptr && body_.expr(field->base).kind == ExprKind::Self) return {e.kind, field->field};
    return {};
  }

  void block(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      if (body_.stmt(id).kind == StmtKind::For) tryLoop(id);
      const Stmt stmt = body_.stmt(id);  // a copy: changing the loop adds statements
      forEachBlock(body_, stmt, [&](StmtId inner) { block(inner); });
    }
  }

  void tryLoop(StmtId loop) {
    uint64_t last_iteration = 0;
    const ForStmt node = body_.stmt(loop).as<ForStmt>();
    if (!lastIteration(node, last_iteration)) return;
    const StmtId first = node.body_block;
    StmtId last = first;
    bool has_inner_loop = false;
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      has_inner_loop = has_inner_loop || body_.stmt(id).kind == StmtKind::For;
      last = id;
    }
    if (!has_inner_loop || body_.stmt(last).kind != StmtKind::Assign) return;
    const AssignStmt store = body_.stmt(last).as<AssignStmt>();
    const TypeId type = body_.expr(store.value).type;
    const Scalar control = scalarAt(node.control), value = scalarAt(store.value);
    if (!control || !value || value == control || body_.expr(store.place).kind != ExprKind::Index ||
        body_.expr(store.place).type != type) {
      return;
    }
    if (!isClosed(first) || !isWritten(first, value) || isWritten(first, control) || !beginsWithWrite(first, value))
      return;
    if (!isFixed(store.place, first, control)) return;

    Builder builder(module_, body_);
    builder.loc = body_.stmt(last).loc;
    const ExprId variable = builder.copy(store.value), stored = builder.copy(store.place);
    atLastIteration(stored, control, last_iteration);
    const uint32_t temp = builder.temp(type);
    rename(first, value, temp);
    const Block outer = builder.open();
    const StmtId after = builder.assign(variable, stored);
    builder.close(outer);
    body_.stmt(after).next = body_.stmt(loop).next;
    body_.stmt(loop).next = after;
    changed_ = true;
  }

  // The control variable's value in the last iteration, if there is one.
  bool lastIteration(const ForStmt& loop, uint64_t& value) const {
    const Expr &from = body_.expr(loop.from), &to = body_.expr(loop.to), &step = body_.expr(loop.step);
    if (!isConst(from) || !isConst(to) || !isConst(step)) return false;
    const auto low = static_cast<int64_t>(bitsOf(from)), high = static_cast<int64_t>(bitsOf(to)),
               by = static_cast<int64_t>(bitsOf(step));
    constexpr int64_t kMax = int64_t{1} << 40;  // far from any limit
    if (low < -kMax || low > kMax || high < -kMax || high > kMax || by < -kMax || by > kMax || by == 0) return false;
    if (by > 0 ? low > high : low < high) return false;
    value = static_cast<uint64_t>(low + (high - low) / by * by);
    return true;
  }

  // Only assignments, branches and loops that run to their end, none of which may fault, on variables of this body.
  bool isClosed(StmtId first) const {
    bool closed = true;
    forEachStmt(body_, first, [&](StmtId id) {
      const Stmt& s = body_.stmt(id);
      closed = closed && (s.kind == StmtKind::Assign || s.kind == StmtKind::If || s.kind == StmtKind::Switch ||
                          s.kind == StmtKind::For);
      if (!closed) return;
      forEachRoot(module_, body_, s, [&](ExprId root, Use) {
        forEachExpr(body_, root, [&](ExprId e) { closed = closed && isOwn(body_.expr(e)); });
        closed = closed && body_.expr(root).kind != ExprKind::Self;  // not the instance as a whole
      });
    });
    return closed;
  }
  bool isOwn(const Expr& e) const {
    if (e.checks != 0) return false;
    if (const uint32_t* local = localOf(e)) return !body_.locals[*local].by_reference;
    if (const auto* field = e.tryAs<FieldExpr>()) {
      const types::TypeInfo& record = types_.info(types_.resolve(body_.expr(field->base).type));
      return record.record_kind != types::RecordKind::Union && !record.fields[field->field].by_reference;
    }
    const bool is_shared = roleOf(e.kind) == ExprRole::Variable && e.kind != ExprKind::Self;
    return !is_shared && e.kind != ExprKind::Deref && e.kind != ExprKind::Address;
  }

  bool isWritten(StmtId first, const Scalar& of) const {
    bool found = false;
    forEachStmt(body_, first, [&](StmtId id) {
      forEachWritten(module_, body_, body_.stmt(id), [&](ExprId place) {
        while (const auto* bits = body_.expr(place).tryAs<BitsExpr>()) place = bits->base;
        found = found || scalarAt(place) == of;
      });
    });
    return found;
  }
  bool mentions(ExprId root, const Scalar& of) const {
    bool found = false;
    forEachExpr(body_, root, [&](ExprId e) { found = found || scalarAt(e) == of; });
    return found;
  }
  bool mentions(const Stmt& stmt, const Scalar& of) const {
    bool found = false;
    forEachRoot(module_, body_, stmt, [&](ExprId root, Use) { found = found || mentions(root, of); });
    forEachBlock(body_, stmt, [&](StmtId block) {
      for (StmtId id = block; id && !found; id = body_.stmt(id).next) found = mentions(body_.stmt(id), of);
    });
    return found;
  }
  bool beginsWithWrite(StmtId first, const Scalar& of) const {
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& s = body_.stmt(id);
      const auto* assign = s.tryAs<AssignStmt>();
      if (assign != nullptr && scalarAt(assign->place) == of) return !mentions(assign->value, of);
      if (mentions(s, of)) return false;
    }
    return false;
  }

  // Tells whether a place is the same after the loop as at its end, apart from the control variable: its indices are
  // sums and products of variables that the loop does not write.
  bool isFixed(ExprId place, StmtId first, const Scalar& control) const {
    bool fixed = true;
    forEachExpr(body_, place, [&](ExprId id) {
      const Expr& e = body_.expr(id);
      if (id == place || !TypeTable::isScalar(types_.plainKind(e.type))) return;
      const Scalar of = scalarAt(id);
      fixed = fixed && (of ? of == control || !isWritten(first, of)
                           : isConst(e) || e.kind == ExprKind::Unary || e.kind == ExprKind::Binary ||
                                 e.kind == ExprKind::Convert);
    });
    return fixed;
  }

  void atLastIteration(ExprId id, const Scalar& control, uint64_t value) {
    Expr& e = body_.expr(id);
    if (scalarAt(id) == control) return becomeConst(e, e.type, value);
    forEachOperand(body_, e, [&](ExprId operand) { atLastIteration(operand, control, value); });
  }
  void renameIn(ExprId id, const Scalar& of, uint32_t temp) {
    Expr& e = body_.expr(id);
    if (scalarAt(id) == of) return e.set(LocalExpr{temp});
    forEachOperand(body_, e, [&](ExprId operand) { renameIn(operand, of, temp); });
  }
  void rename(StmtId first, const Scalar& of, uint32_t temp) {
    forEachStmt(body_, first, [&](StmtId id) {
      forEachRoot(module_, body_, body_.stmt(id), [&](ExprId root, Use) { renameIn(root, of, temp); });
    });
  }

  Module& module_;
  const TypeTable& types_;
  Body& body_;
  bool changed_ = false;
};

}  // namespace

bool privatize(Module& module, Body& body) { return Privatizer(module, body).run(); }

}  // namespace rung::ir
