// SPDX-License-Identifier: Apache-2.0
// Instructions, labels, operands and the frame of a body: see frame_code.h.
#include "ir/interpreter/frame_code.h"

#include <algorithm>

#include "frontend/source/invariant.h"

namespace rung::ir::interpreter {

using types::TypeKind;
using types::TypeTable;

namespace {

constexpr uint32_t kNowhere = ~0u;

uint32_t alignUp(uint64_t value, uint32_t align) { return static_cast<uint32_t>((value + align - 1) / align * align); }

}  // namespace

void FrameCode::beginFrame() {
  outgoing_.clear();
  labels_.clear();
  jumps_.clear();
  table_jumps_.clear();
  top_ = frame_ = kFrameHeader;
  native_slots_ = 0;
}

uint32_t FrameCode::emit(Handler run, Ref a, Ref b, Ref c, uint32_t d, int64_t imm) {
  RUNG_INVARIANT(run != nullptr, "an instruction for these operands exists");
  const auto at = static_cast<uint32_t>(code_.insns.size());
  code_.insns.push_back({run, a.offset, b.offset, c.offset, d, imm});
  if (a.outgoing) outgoing_.push_back({at, 0});
  if (b.outgoing) outgoing_.push_back({at, 1});
  if (c.outgoing) outgoing_.push_back({at, 2});
  return at;
}

FrameCode::Label FrameCode::newLabel() {
  labels_.push_back(kNowhere);
  return static_cast<Label>(labels_.size() - 1);
}

void FrameCode::place(Label label) { labels_[label] = static_cast<uint32_t>(code_.insns.size()); }

void FrameCode::jump(Label label) { jumpTo(emit(jumpHandler()), label); }

Ref FrameCode::slot(uint64_t size, uint32_t align) {
  const uint32_t at = alignUp(top_, std::max(align, 8u));
  top_ = at + static_cast<uint32_t>(size);
  frame_ = std::max(frame_, top_);
  return {at, false};
}

uint32_t FrameCode::site(Loc loc, int64_t low, int64_t high) {
  const FilePosition at = filePosition(module_, *body_, loc);
  const NameId pou = body_->spelling ? body_->spelling : body_->name;
  code_.sites.push_back({pool_.add(module_.names.string(pou)), pool_.add(at.path), at.line, at.column, low, high});
  code_.site_insns.push_back(static_cast<uint32_t>(code_.insns.size()));
  return static_cast<uint32_t>(code_.sites.size());
}

// The frame now has its size: resolves where outgoing arguments are and where jumps go.
Code::Entry FrameCode::finishFrame(uint32_t first) {
  const uint32_t size = alignUp(frame_, kFrameAlign);
  for (const Outgoing& out : outgoing_) {
    Insn& insn = code_.insns[out.insn];
    (out.field == 0 ? insn.a : out.field == 1 ? insn.b : insn.c) += size;
  }
  for (const auto& [insn, label] : jumps_) code_.insns[insn].d = labels_[label] - insn;
  for (const TableJump& jump : table_jumps_) *jump.to = static_cast<int32_t>(labels_[jump.label] - jump.insn);
  return {first, size + native_slots_ + kFrameHeader};
}

Scalar FrameCode::scalarOf(TypeId type) const {
  const TypeKind kind = types_.plainKind(type);
  if (kind == TypeKind::Real) return Scalar::F32;
  if (kind == TypeKind::LReal) return Scalar::F64;
  if (kind == TypeKind::Bool) return Scalar::Bool;
  const bool is_signed = TypeTable::isScalar(kind) && types_.isSigned(kind);
  switch (TypeTable::bitWidth(kind)) {
    case 8: return is_signed ? Scalar::I8 : Scalar::U8;
    case 16: return is_signed ? Scalar::I16 : Scalar::U16;
    case 32: return is_signed ? Scalar::I32 : Scalar::U32;
    default: return is_signed ? Scalar::I64 : Scalar::U64;  // pointers too
  }
}

void FrameCode::move(Scalar type, const Operand& from, const Operand& to) {
  if (from == to) return;
  emit(moveHandler(type, from.mode, to.mode), to.ref, from.ref, {}, 0, from.imm);
}

Operand FrameCode::inFrame(const Operand& from, Scalar type) {
  if (from.mode == Mode::Frame) return from;
  const Operand to = temp();
  move(type, from, to);
  return to;
}

Address shifted(Address a, uint64_t bytes) {
  if (a.base == Base::Pointer || a.base == Base::Constant) {
    a.offset += static_cast<uint32_t>(bytes);
  } else {
    a.ref.offset += static_cast<uint32_t>(bytes);
  }
  return a;
}

void FrameCode::pointerInto(const Address& a, Ref to) {
  emit(leaHandler(a.base), to, a.ref, {a.offset, false}, 0, a.imm);
}

Ref FrameCode::pointerTo(const Address& a) {
  if (a.base == Base::Pointer && a.offset == 0) return a.ref;
  const Ref to = slot();
  pointerInto(a, to);
  return to;
}

Operand FrameCode::read(const Address& from, Scalar type, const Operand* want) {
  if (isDirect(from)) return direct(from);
  if (from.bit != kNoBit) {
    const Operand to = want != nullptr && want->mode == Mode::Frame ? *want : temp();
    const bool is_pointer = from.base == Base::Pointer;
    const Ref pointer = is_pointer ? from.ref : pointerTo(from);
    emit(loadBitHandler(), to.ref, pointer, {is_pointer ? from.offset : 0, false}, from.bit);
    return to;
  }
  const bool is_pointer = from.base == Base::Pointer;
  const Ref pointer = is_pointer ? from.ref : pointerTo(from);
  const Operand to = target(want);
  emit(loadHandler(type, to.mode), to.ref, pointer, {is_pointer ? from.offset : 0, false});
  return to;
}

void FrameCode::write(const Address& to, Scalar type, const Operand& value) {
  if (isDirect(to)) return move(type, value, direct(to));
  const bool is_pointer = to.base == Base::Pointer;
  const Ref pointer = is_pointer ? to.ref : pointerTo(to);
  const Ref offset{is_pointer ? to.offset : 0, false};
  if (to.bit != kNoBit) {
    emit(storeBitHandler(), pointer, offset, inFrame(value, Scalar::Bool).ref, to.bit);
  } else {
    emit(storeHandler(type, value.mode), pointer, offset, value.ref, 0, value.imm);
  }
}

void FrameCode::copyAggregate(const Address& to, const Address& from, uint64_t size) {
  const auto base = [&](const Address& a) -> Address {
    if (a.base == Base::Frame || a.base == Base::Self || (a.base == Base::Constant && a.offset == 0)) return a;
    return {Base::Pointer, pointerTo(a), 0, 0, kNoBit};
  };
  const Address a = base(to), b = base(from);
  emit(copyHandler(a.base, b.base), a.ref, b.ref, {static_cast<uint32_t>(size), false}, 0, b.imm);
}

}  // namespace rung::ir::interpreter
