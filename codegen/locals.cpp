// Chooses the scalars that live in C++ locals: fields of a block that nothing else can reach while it runs and that
// are used often are loaded at entry, and written back at the exits and in the fault block. A control that only its
// loop writes gets a local wider than its type, so the loop needs no test for the limit of the type.
#include "codegen/body.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::TypeTable;

namespace {

constexpr uint32_t kLoopWeight = 4, kMaxWeight = 64, kWorthIt = 3;

}  // namespace

BodyWriter::Slot BodyWriter::slotOf(ExprId id) const {
  const Expr* e = &expr(id);
  while (e->kind == ExprKind::Bits) e = &expr(ExprId{e->a});
  if (e->kind == ExprKind::Local && !body_->locals[e->a].by_reference) return {Slot::Local, e->a};
  if (e->kind == ExprKind::Field && expr(ExprId{e->a}).kind == ExprKind::Self && e->b < fields_.size())
    return {Slot::Field, e->b};
  return {};
}

BodyWriter::Variable* BodyWriter::variableOf(Slot slot) {
  switch (slot.kind) {
    case Slot::None: return nullptr;
    case Slot::Local: return &locals_[slot.index];
    case Slot::Field: return &fields_[slot.index];
  }
  return nullptr;
}

void BodyWriter::scanExpr(ExprId id, uint32_t weight) {
  const Expr& e = expr(id);
  switch (e.kind) {
    case ExprKind::Local: locals_[e.a].weight += weight; return;
    case ExprKind::Self: self_escapes_ = true; return;
    case ExprKind::Field:
      if (expr(ExprId{e.a}).kind == ExprKind::Self) {
        if (e.b < fields_.size()) {
          fields_[e.b].weight += weight;
          if (weight > 1) fields_[e.b].loop_weight += weight;
        }
        return;
      }
      break;
    case ExprKind::Address: {
      Slot slot = slotOf(ir::rootOf(*body_, ExprId{e.a}));
      if (!slot.kind) slot = slotOf(ExprId{e.a});
      if (Variable* of = variableOf(slot)) of->exposed = true;
      if (Variable* of = stringVariable(ExprId{e.a})) of->exposed = true;
      break;
    }
    case ExprKind::Call: noteSizedCall(module_.body(ir::BodyId{e.a}), e.b, e.c, weight); break;
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::String:
    case ExprKind::Data:
    case ExprKind::Zero:
    case ExprKind::Global:
    case ExprKind::Program:
    case ExprKind::Image:
    case ExprKind::Index:
    case ExprKind::Deref:
    case ExprKind::Bits:
    case ExprKind::Unary:
    case ExprKind::Binary:
    case ExprKind::Convert:
    case ExprKind::Select: break;
  }
  ir::forEachSlot(*body_, e, [&](const uint32_t& slot) { scanExpr(ExprId{slot}, weight); });
}

void BodyWriter::noteWrite(ExprId place, bool by_reference) {
  const Slot slot = slotOf(place);
  if (Variable* of = by_reference ? stringVariable(place) : nullptr) of->exposed = true;
  Variable* of = variableOf(slot);
  if (of == nullptr) {  // part of an aggregate: the local is in use
    const Expr& root = expr(ir::rootOf(*body_, place));
    if (root.kind == ExprKind::Local) locals_[root.a].written = true;
    return;
  }
  of->written = true;
  if (by_reference) of->exposed = true;
  for (Control& control : controls_) {
    if (control.slot == slot) control.disturbed = true;
  }
}

void BodyWriter::scanBlock(StmtId first, uint32_t weight) {
  for (StmtId id = first; id; id = body_->stmt(id).next) {
    const Stmt& stmt = body_->stmt(id);
    const bool is_block_call = stmt.kind == StmtKind::Call && stmt.b != 0;
    ir::forEachRoot(module_, *body_, stmt, [&](const uint32_t& slot, ir::Use use) {
      const ExprId root{slot};
      // A call on SELF exposes the whole instance; an element of it is a separate instance.
      scanExpr(root, weight);
      if (use == ir::Use::Write) noteWrite(root, false);
      if (use == ir::Use::Reference && !(is_block_call && slot == stmt.b)) noteWrite(root, true);
    });
    if (stmt.kind == StmtKind::Try) has_try_ = true;
    if (stmt.kind == StmtKind::Assign) noteStringAssign(stmt, weight);
    if (stmt.kind == StmtKind::Call) {
      has_calls_ = true;
      const Body& callee = module_.body(ir::BodyId{stmt.a});
      if (!callee.pure && !callee.library) has_foreign_calls_ = true;
      if (callee.may_fault || (stmt.op & ir::kVirtual) != 0 || (callee.native && !callee.pure))
        has_leaving_calls_ = true;
      if (callee.slice) noteSlice(stmt, weight);
      noteSizedCall(callee, stmt.c, stmt.d, weight);
      if (Variable* of = stmt.e != 0 && isSized(callee) ? stringVariable(ExprId{stmt.e}) : nullptr)
        of->sized_weight += weight;
    }
    const bool loops = stmt.kind == StmtKind::For || stmt.kind == StmtKind::Loop;
    const uint32_t inner = loops && weight < kMaxWeight ? weight * kLoopWeight : weight;
    if (stmt.kind == StmtKind::For) {
      if (private_loop_.empty()) private_loop_.resize(body_->stmts.size());
      const Slot slot = slotOf(ExprId{stmt.a});
      if (Variable* of = variableOf(slot)) {
        of->weight += inner;
        of->loop_weight += inner;
      }
      controls_.push_back({slot, id});
      scanBlock(StmtId{stmt.e}, inner);
      private_loop_[id.index] =
          slot.kind != Slot::None && !controls_.back().disturbed && expr(ExprId{stmt.a}).kind != ExprKind::Bits;
      controls_.pop_back();
      continue;
    }
    ir::forEachBlock(*body_, stmt, [&](const uint32_t& block) { scanBlock(StmtId{block}, inner); });
  }
}

// True when the control never takes a value outside of its type.
bool BodyWriter::boundsFit(const Stmt& loop) const {
  const Expr& to = expr(ExprId{loop.c});
  if (to.kind != ExprKind::Const) return false;
  const TypeKind kind = kindOf(ExprId{loop.a});
  const auto step = static_cast<__int128>(static_cast<int64_t>(expr(ExprId{loop.d}).bits()));
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  const __int128 low = is_signed ? -(static_cast<__int128>(1) << (width - 1)) : 0;
  const __int128 high = (static_cast<__int128>(1) << (is_signed ? width - 1 : width)) - 1;
  const __int128 bound =
      is_signed ? static_cast<__int128>(static_cast<int64_t>(to.bits())) : static_cast<__int128>(to.bits());
  return bound + step >= low && bound + step <= high;
}

void BodyWriter::analyze() {
  locals_.assign(body_->locals.size(), {});
  fields_.clear();
  private_loop_.clear();
  controls_.clear();
  const bool is_block = body_->kind == ir::BodyKind::Block && body_->self;
  const TypeId record = body_->self ? types_.resolve(body_->self) : TypeId{};
  if (is_block) fields_.resize(types_.info(record).fields.size());
  scanBlock(body_->first, 1);

  if (has_try_ || self_escapes_ || (is_block && facts_.is_seen[record.index] == 1 && has_foreign_calls_) ||
      (is_block && types_.info(record).record_kind == types::RecordKind::Union)) {
    fields_.clear();
  }
  for (uint32_t i = 0; i < fields_.size(); ++i) {
    const types::Field& field = types_.info(record).fields[i];
    const TypeKind kind = types_.plainKind(field.type);
    Variable& use = fields_[i];
    if (field.by_reference || !TypeTable::isScalar(kind) || use.exposed) continue;
    // Across a call a local is spilled, no better than memory: then only its uses in loops count.
    if ((has_calls_ ? use.loop_weight : use.weight) <= kWorthIt) continue;
    use.cached = !facts_.isExposed(record, i);
  }
  chooseMeasured();
  chooseSlices();
  // Controls.
  for (uint32_t i = 0; i < private_loop_.size(); ++i) {
    if (private_loop_[i] == 0) continue;
    const Stmt& loop = body_->stmts[i];
    const Slot slot = slotOf(ExprId{loop.a});
    Variable* of = variableOf(slot);
    const uint32_t width = widthOf(kindOf(ExprId{loop.a}));
    const bool is_parameter = slot.kind == Slot::Local && body_->locals[slot.index].kind == ir::LocalKind::Input;
    if (of == nullptr || of->exposed || has_try_ || is_parameter || (slot.kind == Slot::Field && !of->cached) ||
        width >= 64 || width == 0) {
      private_loop_[i] = width == 64 && of != nullptr && !of->exposed && !has_try_ && boundsFit(loop) &&
                         (slot.kind == Slot::Local || of->cached);
      continue;
    }
    if (width <= 16) {
      of->wide = 32;
    } else if (!boundsFit(loop)) {
      of->wide = 64;
    }
  }
}

}  // namespace rung::codegen
