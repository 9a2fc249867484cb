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
  while (const auto* bits = expr(id).tryAs<ir::BitsExpr>()) id = bits->base;
  const uint32_t* local = ir::localOf(expr(id));
  if (local != nullptr && !body_->locals[*local].by_reference) return {Slot::Local, *local};
  const auto* field = expr(id).tryAs<ir::FieldExpr>();
  if (field != nullptr && expr(field->base).kind == ExprKind::Self && field->field < fields_.size())
    return {Slot::Field, field->field};
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
    case ExprKind::Local: locals_[e.as<ir::LocalExpr>().local].weight += weight; return;
    case ExprKind::Self: self_escapes_ = true; return;
    case ExprKind::Field: {
      const auto [base, field] = e.as<ir::FieldExpr>();
      if (expr(base).kind != ExprKind::Self) break;
      if (field < fields_.size()) {
        fields_[field].weight += weight;
        if (weight > 1) fields_[field].loop_weight += weight;
      }
      return;
    }
    case ExprKind::Address: {
      const ExprId place = e.as<ir::AddressExpr>().place;
      Slot slot = slotOf(ir::rootOf(*body_, place));
      if (!slot.kind) slot = slotOf(place);
      if (Variable* of = variableOf(slot)) of->exposed = true;
      if (Variable* of = stringVariable(place)) of->exposed = true;
      break;
    }
    case ExprKind::Call: {
      const auto [callee, operands] = e.as<ir::CallExpr>();
      noteSizedCall(module_.body(callee), operands, weight);
      break;
    }
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
  ir::forEachOperand(*body_, e, [&](ExprId operand) { scanExpr(operand, weight); });
}

void BodyWriter::noteWrite(ExprId place, bool by_reference) {
  const Slot slot = slotOf(place);
  if (Variable* of = by_reference ? stringVariable(place) : nullptr) of->exposed = true;
  Variable* of = variableOf(slot);
  if (of == nullptr) {  // part of an aggregate: the local is in use
    if (const uint32_t* local = ir::localOf(expr(ir::rootOf(*body_, place)))) locals_[*local].written = true;
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
    const auto* call = stmt.tryAs<ir::CallStmt>();
    ir::forEachRoot(module_, *body_, stmt, [&](ExprId root, ir::Use use) {
      // A call on SELF exposes the whole instance; an element of it is a separate instance.
      scanExpr(root, weight);
      if (use == ir::Use::Write) noteWrite(root, false);
      if (use == ir::Use::Reference && !(call != nullptr && root == call->self)) noteWrite(root, true);
    });
    if (stmt.kind == StmtKind::Try) has_try_ = true;
    if (const auto* assign = stmt.tryAs<ir::AssignStmt>()) noteStringAssign(*assign, weight);
    if (call != nullptr) {
      has_calls_ = true;
      const Body& callee = module_.body(call->callee);
      if (!callee.pure && !callee.library) has_foreign_calls_ = true;
      if (callee.may_fault || call->is_virtual || (callee.native && !callee.pure)) has_leaving_calls_ = true;
      if (callee.slice) noteSlice(call->result, weight);
      noteSizedCall(callee, call->operands, weight);
      if (Variable* of = call->result && isSized(callee) ? stringVariable(call->result) : nullptr)
        of->sized_weight += weight;
    }
    const bool loops = stmt.kind == StmtKind::For || stmt.kind == StmtKind::Loop;
    const uint32_t inner = loops && weight < kMaxWeight ? weight * kLoopWeight : weight;
    if (const auto* loop = stmt.tryAs<ir::ForStmt>()) {
      if (private_loop_.empty()) private_loop_.resize(body_->stmts.size());
      const Slot slot = slotOf(loop->control);
      if (Variable* of = variableOf(slot)) {
        of->weight += inner;
        of->loop_weight += inner;
      }
      controls_.push_back({slot, id});
      scanBlock(loop->body_block, inner);
      private_loop_[id.index] =
          slot.kind != Slot::None && !controls_.back().disturbed && expr(loop->control).kind != ExprKind::Bits;
      controls_.pop_back();
      continue;
    }
    ir::forEachBlock(*body_, stmt, [&](StmtId block) { scanBlock(block, inner); });
  }
}

// True when the control never takes a value outside of its type.
bool BodyWriter::boundsFit(const ir::ForStmt& loop) const {
  if (!ir::isConst(expr(loop.to))) return false;
  const uint64_t to = ir::bitsOf(expr(loop.to));
  const TypeKind kind = kindOf(loop.control);
  const auto step = static_cast<__int128>(static_cast<int64_t>(ir::bitsOf(expr(loop.step))));
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  const __int128 low = is_signed ? -(static_cast<__int128>(1) << (width - 1)) : 0;
  const __int128 high = (static_cast<__int128>(1) << (is_signed ? width - 1 : width)) - 1;
  const __int128 bound = is_signed ? static_cast<__int128>(static_cast<int64_t>(to)) : static_cast<__int128>(to);
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
    const ir::ForStmt& loop = body_->stmts[i].as<ir::ForStmt>();
    const Slot slot = slotOf(loop.control);
    Variable* of = variableOf(slot);
    const uint32_t width = widthOf(kindOf(loop.control));
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
