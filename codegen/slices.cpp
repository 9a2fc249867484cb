// Slices: strings that need no memory while the body runs, because they are parts of strings that do not change.
// In `rest := MID(rest, LEN(rest) - at, at + 1)` nothing moves: the address and the length of `rest` change, and at the
// exits and in the fault block its characters are copied into the instance, once. A string becomes a slice when
//   - its length lives in a local (lengths.cpp), and functions marked {slice} (LEFT, RIGHT, MID) make it in a loop;
//   - every write makes it a part of a literal, of another slice, or of a string that this body never writes;
//   - every read comes after a write of it, and takes a length: a slice has no NUL at its end;
//   - at least one write makes it from a slice, itself or another: a string is taken apart piece by piece. Pieces of an
//     unchanging string that stay whole are copied: a store or two, and a single character stays in a register;
//   - the body calls nothing that may fault or that the host may answer, so only its own code leaves it.
// The sources of slices do not change, so slices may be written back in any order. Called by locals.cpp once it is
// known which lengths live in locals; written by strings.cpp and statements.cpp.
#include <algorithm>

#include "codegen/body.h"
#include "ir/walk.h"

namespace rung::codegen {

using ir::LocalKind;

const BodyWriter::Variable* BodyWriter::slicedString(ExprId place) const {
  if (!has_slices_) return nullptr;
  const Variable* of = measuredString(place);
  return of != nullptr && of->slice ? of : nullptr;
}

// Something that does not change while the body runs, or a part of it.
bool BodyWriter::isSliceSource(ExprId id) {
  const Expr& e = expr(id);
  if (e.kind == ExprKind::String) return !isWide(e.type);
  if (e.kind == ExprKind::Zero) return true;
  const Variable* of = stringVariable(id);
  if (of == nullptr || of->slice) return of != nullptr;
  if (of->written || of->exposed) return false;
  if (const uint32_t* local = ir::localOf(e)) return body_->locals[*local].kind == LocalKind::Input;
  const ir::FieldExpr& field = e.as<ir::FieldExpr>();
  return !facts_.isExposed(types_.resolve(body_->self), field.field) && !fieldOf(field).by_reference;
}

// ---- choosing the strings

void BodyWriter::noteSlice(ExprId result, uint32_t weight) {
  Variable* of = result ? stringVariable(result) : nullptr;
  if (of == nullptr) return;
  // A string of the instance is written back at the exits: that pays in loops only.
  if (weight > 1 || expr(result).kind == ExprKind::Local) of->sliced = has_slices_ = true;
}

// Starts with all candidates and drops those that break a condition.
void BodyWriter::chooseSlices() {
  if (has_leaving_calls_) has_slices_ = false;
  if (!has_slices_) return;
  for (uint32_t i = 0; i < locals_.size(); ++i) {
    const LocalKind kind = body_->locals[i].kind;
    locals_[i].slice =
        locals_[i].measured && locals_[i].sliced && (kind == LocalKind::Temp || kind == LocalKind::Variable);
  }
  for (Variable& of : fields_) of.slice = of.measured && of.sliced;
  do {
    slices_changed_ = false;
    judgeBlock(body_->first);
    if (slices_changed_) continue;
    for (std::vector<Variable>* variables : {&locals_, &fields_}) {
      for (Variable& of : *variables) {
        slices_changed_ = slices_changed_ || (of.slice && !of.taken_apart);
        of.slice = of.slice && of.taken_apart;
      }
    }
  } while (slices_changed_);
}

void BodyWriter::refuseSlice(ExprId place) {
  stringVariable(place)->slice = false;
  slices_changed_ = true;
}

void BodyWriter::judgeWrite(ExprId place, bool makes_slice) {
  if (stringVariable(place) != nullptr) {
    if (!makes_slice && slicedString(place) != nullptr) refuseSlice(place);
    setKnown(place);
  } else {
    ir::forEachOperand(*body_, expr(place), [&](ExprId operand) { judgeRead(operand, false); });
  }
}

// is_sized: the reader receives the length.
void BodyWriter::judgeRead(ExprId id, bool is_sized) {
  const Expr& e = expr(id);
  if (const Variable* of = slicedString(id)) {
    if (!is_sized || !of->known) refuseSlice(id);
    return;
  }
  bool reads_sized = false;
  if (const auto* call = e.tryAs<ir::CallExpr>())
    reads_sized = !isString(e.type) && isSizedCall(module_.body(call->callee), call->operands, {});
  if (const auto* comparison = e.tryAs<ir::BinaryExpr>()) reads_sized = isSizedComparison(*comparison);
  ir::forEachOperand(*body_, e, [&](ExprId operand) { judgeRead(operand, reads_sized); });
}

void BodyWriter::judgeBlock(StmtId first) {
  const size_t mark = known_.size();
  for (StmtId id = first; id; id = body_->stmt(id).next) {
    const Stmt& stmt = body_->stmt(id);
    if (const auto* assign = stmt.tryAs<ir::AssignStmt>()) {
      const ExprId to = assign->place, from = uncut(assign->value);
      judgeRead(from, isString(expr(to).type) && !isWide(expr(to).type));
      judgeWrite(to, isSliceSource(from));
    } else if (const auto* call = stmt.tryAs<ir::CallStmt>()) {
      const Body& callee = module_.body(call->callee);
      const std::span<const ExprId> operands = body_->list(call->operands);
      const bool is_sized = !call->self && isSizedCall(callee, call->operands, call->result);
      if (call->self) judgeRead(call->self, false);
      for (const ExprId operand : operands) {
        if (operand) judgeRead(operand, is_sized);
      }
      if (call->result) {
        const bool makes_slice = is_sized && callee.slice && isSliceSource(operands[0]);
        judgeWrite(call->result, makes_slice);
        if (makes_slice && slicedString(operands[0]) != nullptr) stringVariable(call->result)->taken_apart = true;
      }
    } else {
      ir::forEachRoot(module_, *body_, stmt, [&](ExprId root, ir::Use) { judgeRead(root, false); });
    }
    ir::forEachBlock(*body_, stmt, [&](StmtId block) { judgeBlock(block); });
  }
  forgetLengths(mark);
}

// ---- writing

void BodyWriter::sliceName(ExprId id) {
  lengthName(id);
  out_.back() = 'v';
}

void BodyWriter::assignSlice(ExprId to, ExprId from) {
  uint32_t capacity = capacityOf(expr(to).type);
  for (ExprId cut = from; cut != uncut(from); cut = expr(cut).as<ir::ConvertExpr>().operand)
    capacity = std::min(capacity, capacityOf(expr(cut).type));
  from = uncut(from);
  sliceName(to);
  out_ += " = ";
  stringValue(from);
  out_ += "; ";
  lengthName(to);
  out_ += " = ";
  const Expr& source = expr(from);
  if (source.kind == ExprKind::String) {
    appendUnsigned(out_, std::min(literalLength(source), capacity));
  } else if (source.kind == ExprKind::Zero || capacityOf(source.type) <= capacity) {
    stringLength(from);
  } else {
    out_ += "rung_min_u32(";
    stringLength(from);
    out_ += ", ";
    appendUnsigned(out_, capacity);
    out_ += ')';
  }
  out_ += ';';
}

}  // namespace rung::codegen
