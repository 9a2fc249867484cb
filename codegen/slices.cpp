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
  if (e.kind == ExprKind::Local) return body_->locals[e.a].kind == LocalKind::Input;
  const TypeId record = types_.resolve(body_->self);
  return !facts_.isExposed(record, e.b) && !types_.info(record).fields[e.b].by_reference;
}

// ---- choosing the strings

void BodyWriter::noteSlice(const Stmt& stmt, uint32_t weight) {
  Variable* of = stmt.e != 0 ? stringVariable(ExprId{stmt.e}) : nullptr;
  if (of == nullptr) return;
  // A string of the instance is written back at the exits: that pays in loops only.
  if (weight > 1 || expr(ExprId{stmt.e}).kind == ExprKind::Local) of->sliced = has_slices_ = true;
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
    ir::forEachSlot(*body_, expr(place), [&](const uint32_t& slot) { judgeRead(ExprId{slot}, false); });
  }
}

// is_sized: the reader receives the length.
void BodyWriter::judgeRead(ExprId id, bool is_sized) {
  const Expr& e = expr(id);
  if (const Variable* of = slicedString(id)) {
    if (!is_sized || !of->known) refuseSlice(id);
    return;
  }
  bool reads_sized =
      e.kind == ExprKind::Call && !isString(e.type) && isSizedCall(module_.body(ir::BodyId{e.a}), e.b, e.c, {});
  if (e.kind == ExprKind::Binary) reads_sized = isSizedComparison(e);
  ir::forEachSlot(*body_, e, [&](const uint32_t& slot) { judgeRead(ExprId{slot}, reads_sized); });
}

void BodyWriter::judgeBlock(StmtId first) {
  const size_t mark = known_.size();
  for (StmtId id = first; id; id = body_->stmt(id).next) {
    const Stmt& stmt = body_->stmt(id);
    if (stmt.kind == StmtKind::Assign) {
      const ExprId to{stmt.a}, from = uncut(ExprId{stmt.b});
      judgeRead(from, isString(expr(to).type) && !isWide(expr(to).type));
      judgeWrite(to, isSliceSource(from));
    } else if (stmt.kind == StmtKind::Call) {
      const Body& callee = module_.body(ir::BodyId{stmt.a});
      const bool is_sized = stmt.b == 0 && isSizedCall(callee, stmt.c, stmt.d, ExprId{stmt.e});
      if (stmt.b != 0) judgeRead(ExprId{stmt.b}, false);
      for (uint32_t i = 0; i < stmt.d; ++i) {
        if (const ExprId operand = body_->operands[stmt.c + i]) judgeRead(operand, is_sized);
      }
      if (stmt.e != 0) {
        const bool makes_slice = is_sized && callee.slice && isSliceSource(body_->operands[stmt.c]);
        judgeWrite(ExprId{stmt.e}, makes_slice);
        if (makes_slice && slicedString(body_->operands[stmt.c]) != nullptr)
          stringVariable(ExprId{stmt.e})->taken_apart = true;
      }
    } else {
      ir::forEachRoot(module_, *body_, stmt, [&](const uint32_t& slot, ir::Use) { judgeRead(ExprId{slot}, false); });
    }
    ir::forEachBlock(*body_, stmt, [&](const uint32_t& block) { judgeBlock(StmtId{block}); });
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
  for (ExprId cut = from; cut != uncut(from); cut = ExprId{expr(cut).a})
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
