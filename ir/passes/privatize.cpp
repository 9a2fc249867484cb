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
  Scalar scalarAt(uint32_t id) const {
    const Expr& e = body_.exprs[id];
    if (!TypeTable::isScalar(types_.plainKind(e.type))) return {};
    if (e.kind == ExprKind::Local && !body_.locals[e.a].by_reference) return {e.kind, e.a};
    if (e.kind == ExprKind::Field && body_.exprs[e.a].kind == ExprKind::Self) return {e.kind, e.b};
    return {};
  }

  void block(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      if (body_.stmts[id.index].kind == StmtKind::For) tryLoop(id);
      const Stmt stmt = body_.stmt(id);  // a copy: changing the loop adds statements
      forEachBlock(body_, stmt, [&](const uint32_t& inner) { block(StmtId{inner}); });
    }
  }

  void tryLoop(StmtId loop) {
    uint64_t last_iteration = 0;
    if (!lastIteration(body_.stmt(loop), last_iteration)) return;
    const StmtId first{body_.stmt(loop).e};
    StmtId last = first;
    bool has_inner_loop = false;
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      has_inner_loop = has_inner_loop || body_.stmt(id).kind == StmtKind::For;
      last = id;
    }
    if (!has_inner_loop || body_.stmt(last).kind != StmtKind::Assign) return;
    const Stmt store = body_.stmt(last);
    const Scalar control = scalarAt(body_.stmt(loop).a), value = scalarAt(store.b);
    if (!control || !value || value == control || body_.exprs[store.a].kind != ExprKind::Index ||
        body_.exprs[store.a].type != body_.exprs[store.b].type) {
      return;
    }
    if (!isClosed(first) || !isWritten(first, value) || isWritten(first, control) || !beginsWithWrite(first, value))
      return;
    if (!isFixed(store.a, first, control)) return;

    Builder builder(module_, body_);
    builder.loc = store.loc;
    const TypeId type = body_.exprs[store.b].type;
    const ExprId variable = builder.copy(ExprId{store.b}), stored = builder.copy(ExprId{store.a});
    atLastIteration(stored.index, control, last_iteration);
    const uint32_t temp = builder.temp(type);
    rename(first, value, temp);
    const Block outer = builder.open();
    const StmtId after = builder.assign(variable, stored);
    builder.close(outer);
    body_.stmts[after.index].next = body_.stmt(loop).next;
    body_.stmts[loop.index].next = after;
    changed_ = true;
  }

  // The control variable's value in the last iteration, if there is one.
  bool lastIteration(const Stmt& loop, uint64_t& value) const {
    const Expr &from = body_.exprs[loop.b], &to = body_.exprs[loop.c], &step = body_.exprs[loop.d];
    if (!isConst(from) || !isConst(to) || !isConst(step)) return false;
    const auto low = static_cast<int64_t>(from.bits()), high = static_cast<int64_t>(to.bits()),
               by = static_cast<int64_t>(step.bits());
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
      forEachRoot(module_, body_, s, [&](const uint32_t& slot, Use) {
        forEachExpr(body_, ExprId{slot}, [&](ExprId e) { closed = closed && isOwn(body_.expr(e)); });
        closed = closed && body_.exprs[slot].kind != ExprKind::Self;  // not the instance as a whole
      });
    });
    return closed;
  }
  bool isOwn(const Expr& e) const {
    if (e.checks != 0) return false;
    switch (e.kind) {
      case ExprKind::None:
      case ExprKind::Const:
      case ExprKind::String:
      case ExprKind::Data:
      case ExprKind::Zero:
      case ExprKind::Self:
      case ExprKind::Index:
      case ExprKind::Bits:
      case ExprKind::Unary:
      case ExprKind::Binary:
      case ExprKind::Convert:
      case ExprKind::Select:
      case ExprKind::Call: return true;
      case ExprKind::Local: return !body_.locals[e.a].by_reference;
      case ExprKind::Field: {
        const types::TypeInfo& record = types_.info(types_.resolve(body_.exprs[e.a].type));
        return record.record_kind != types::RecordKind::Union && !record.fields[e.b].by_reference;
      }
      case ExprKind::Global:
      case ExprKind::Program:
      case ExprKind::Image:
      case ExprKind::Deref:
      case ExprKind::Address: return false;
    }
    return false;
  }

  bool isWritten(StmtId first, const Scalar& of) const {
    bool found = false;
    forEachStmt(body_, first, [&](StmtId id) {
      forEachWritten(module_, body_, body_.stmt(id), [&](ExprId place) {
        uint32_t at = place.index;
        while (body_.exprs[at].kind == ExprKind::Bits) at = body_.exprs[at].a;
        found = found || scalarAt(at) == of;
      });
    });
    return found;
  }
  bool mentions(uint32_t root, const Scalar& of) const {
    bool found = false;
    forEachExpr(body_, ExprId{root}, [&](ExprId e) { found = found || scalarAt(e.index) == of; });
    return found;
  }
  bool mentions(const Stmt& stmt, const Scalar& of) const {
    bool found = false;
    forEachRoot(module_, body_, stmt, [&](const uint32_t& slot, Use) { found = found || mentions(slot, of); });
    forEachBlock(body_, stmt, [&](const uint32_t& block) {
      for (StmtId id{block}; id && !found; id = body_.stmt(id).next) found = mentions(body_.stmt(id), of);
    });
    return found;
  }
  bool beginsWithWrite(StmtId first, const Scalar& of) const {
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& s = body_.stmt(id);
      if (s.kind == StmtKind::Assign && scalarAt(s.a) == of) return !mentions(s.b, of);
      if (mentions(s, of)) return false;
    }
    return false;
  }

  // Whether a place is the same after the loop as at its end, apart from the control variable: its indices are sums and
  // products of variables that the loop does not write.
  bool isFixed(uint32_t place, StmtId first, const Scalar& control) const {
    bool fixed = true;
    forEachExpr(body_, ExprId{place}, [&](ExprId id) {
      const Expr& e = body_.expr(id);
      if (id.index == place || !TypeTable::isScalar(types_.plainKind(e.type))) return;
      const Scalar of = scalarAt(id.index);
      fixed = fixed && (of ? of == control || !isWritten(first, of)
                           : isConst(e) || e.kind == ExprKind::Unary || e.kind == ExprKind::Binary ||
                                 e.kind == ExprKind::Convert);
    });
    return fixed;
  }

  void atLastIteration(uint32_t id, const Scalar& control, uint64_t value) {
    Expr& e = body_.exprs[id];
    if (scalarAt(id) == control) return becomeConst(e, e.type, value);
    forEachSlot(body_, e, [&](uint32_t& slot) { atLastIteration(slot, control, value); });
  }
  void renameIn(uint32_t id, const Scalar& of, uint32_t temp) {
    Expr& e = body_.exprs[id];
    if (scalarAt(id) == of) {
      e.kind = ExprKind::Local;
      e.a = temp;
      e.b = e.c = 0;
      return;
    }
    forEachSlot(body_, e, [&](uint32_t& slot) { renameIn(slot, of, temp); });
  }
  void rename(StmtId first, const Scalar& of, uint32_t temp) {
    forEachStmt(body_, first, [&](StmtId id) {
      forEachRoot(module_, body_, body_.stmt(id), [&](const uint32_t& slot, Use) { renameIn(slot, of, temp); });
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
