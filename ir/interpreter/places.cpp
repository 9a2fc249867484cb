// SPDX-License-Identifier: Apache-2.0
// Places of the translated code: where variables, fields, elements and bits are. See translate.h.
#include "ir/builder.h"
#include "ir/interpreter/translate.h"
#include "ir/walk.h"

namespace rung::ir::interpreter {

using types::Dimension;
using types::TypeInfo;
using types::TypeTable;

Address BodyTranslator::fieldMemory(const Expr& e) {
  const auto [base, field] = e.as<FieldExpr>();
  const uint64_t offset = info(expr(base).type).fields[field].offset;
  return shifted(place(base), offset);
}

Address BodyTranslator::fieldPlace(const Expr& e) {
  const Address at = fieldMemory(e);
  if (!isReference(module_, *body_, e)) return at;
  const Operand own = temp();
  const Operand pointer = inFrame(read(at, Scalar::U64, &own), Scalar::U64);
  if ((e.checks & kCheckNull) != 0) checkNull(pointer, RUNG_FAULT_NULL, e.loc);
  return {Base::Pointer, pointer.ref, 0, 0, kNoBit};
}

void BodyTranslator::checkNull(const Operand& pointer, uint32_t fault, Loc loc) {
  emit(checkNullHandler(), {fault, false}, pointer.ref, {}, site(loc));
}

// A list of globals, or the instance of a program.
Address BodyTranslator::blockMemory(uint32_t block) const {
  for (const auto& [known, at] : block_slots_)
    if (known == block) return {Base::Pointer, at, 0, 0, kNoBit};
  return {};
}

Address BodyTranslator::imageMemory(const ImageExpr& image) const {
  for (const auto& [known, at] : image_slots_)
    if (known == image.area) return {Base::Pointer, at, image.byte, 0, image.bit};
  return {};
}

// Memory is little-endian: a part is at its own bytes.
Address BodyTranslator::bitsPlace(const Expr& e) {
  const uint32_t width = TypeTable::bitWidth(types_.plainKind(e.type));
  const uint32_t position = e.as<BitsExpr>().position;
  const Address base = place(e.as<BitsExpr>().base);
  if (width > 1) return shifted(base, uint64_t{position} * width / 8);
  Address at = shifted(base, position / 8);
  at.bit = position % 8;
  return at;
}

Address BodyTranslator::selectedPlace(const Expr& e) {
  const Operand to = temp();
  const Label otherwise = newLabel(), end = newLabel();
  const auto [condition, yes, no] = e.as<SelectExpr>();
  const auto pointTo = [&](ExprId id) { pointerInto(isString(e.type) ? string(id) : place(id), to.ref); };
  branch(condition, false, otherwise);
  pointTo(yes);
  jump(end);
  place(otherwise);
  pointTo(no);
  place(end);
  return {Base::Pointer, to.ref, 0, 0, kNoBit};
}

Address BodyTranslator::place(ExprId id) {
  const Expr& e = expr(id);
  switch (e.kind) {
    case ExprKind::Local: {
      const uint32_t local = e.as<LocalExpr>().local;
      const Ref at{local_offset_[local], false};
      return {body_->locals[local].by_reference ? Base::Pointer : Base::Frame, at, 0, 0, kNoBit};
    }
    case ExprKind::Self: return {Base::Self, {}, 0, 0, kNoBit};
    case ExprKind::Global: return blockMemory(blocks_.list_block[e.as<GlobalExpr>().list]);
    case ExprKind::Program: return blockMemory(blocks_.program_block[e.as<ProgramExpr>().program]);
    case ExprKind::Image: return imageMemory(e.as<ImageExpr>());
    case ExprKind::Field: return fieldPlace(e);
    case ExprKind::Index: return indexed(e, e.as<IndexExpr>().indices.count);
    case ExprKind::Deref: {
      const Operand pointer = inFrame(value(e.as<DerefExpr>().pointer), Scalar::U64);
      if ((e.checks & (kCheckNull | kCheckCast)) != 0)
        checkNull(pointer, (e.checks & kCheckNull) != 0 ? RUNG_FAULT_NULL : RUNG_FAULT_CAST, e.loc);
      return {Base::Pointer, pointer.ref, 0, 0, kNoBit};
    }
    case ExprKind::Bits: return bitsPlace(e);
    case ExprKind::Data: {
      const uint64_t* const bytes = code_.data_of_module[e.as<DataExpr>().index];
      return {Base::Constant, {}, 0, reinterpret_cast<int64_t>(bytes), kNoBit};
    }
    case ExprKind::Zero: {
      if (isString(e.type)) return string(id);
      const Ref memory = slot(info(e.type).size, info(e.type).align);
      emit(clearHandler(Base::Frame), memory, {}, {static_cast<uint32_t>(info(e.type).size), false});
      return {Base::Frame, memory, 0, 0, kNoBit};
    }
    case ExprKind::Select: return selectedPlace(e);
    case ExprKind::String: return literal(e);
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::Unary:
    case ExprKind::Binary:
    case ExprKind::Convert:
    case ExprKind::Call:
    case ExprKind::Address: break;
  }
  if (isString(e.type)) return string(id);
  return {Base::Frame, inFrame(value(id), scalarOf(id)).ref, 0, 0, kNoBit};
}

// ---- elements

// Instructions take INT, DINT and LINT; others become LINT.
Operand BodyTranslator::indexOperand(ExprId id, Scalar& type) {
  type = scalarOf(id);
  Operand index = value(id);
  if (type != Scalar::I16 && type != Scalar::I32 && type != Scalar::I64) {
    index = wide(index, type);
    type = Scalar::I64;
  }
  return inMemory(index, type);
}

uint32_t BodyTranslator::indexSite(const Expr& e, const Dimension& dimension) {
  return (e.checks & kCheckIndex) != 0 ? site(e.loc, dimension.low, dimension.high) : 0;
}

// The element or, with `count` below the number of dimensions, the part of the array at the first indices.
Address BodyTranslator::indexed(const Expr& e, size_t count) {
  const IndexExpr& node = e.as<IndexExpr>();
  const TypeInfo& array = info(expr(node.base).type);
  Address at = place(node.base);
  uint64_t stride = info(array.base).size;
  std::vector<uint64_t> strides(node.indices.count);
  for (size_t i = strides.size(); i-- > 0;) {
    strides[i] = stride;
    stride *= array.dimensions[i].count();
  }
  for (size_t i = 0; i < count; ++i) {
    const ExprId operand = body_->list(node.indices)[i];
    const Dimension& dimension = array.dimensions[i];
    if (isConst(expr(operand))) {
      const auto number = static_cast<int64_t>(bitsOf(expr(operand)));
      if (number >= dimension.low && number <= dimension.high) {
        at = shifted(at, static_cast<uint64_t>(number - dimension.low) * strides[i]);
        continue;
      }
    }
    Scalar type;
    const Operand number = indexOperand(operand, type);
    if (at.base == Base::Constant) at = {Base::Pointer, pointerTo(at), 0, 0, kNoBit};
    const Ref to = slot();
    emit(elementHandler(type, at.base, number.mode), to, at.ref, number.ref, site(e.loc, dimension.low, dimension.high),
         static_cast<int64_t>(dimension.count()));
    emit(haltHandler(), {static_cast<uint32_t>(strides[i]), false}, {at.base == Base::Pointer ? at.offset : 0, false},
         {}, 0, dimension.low);
    at = {Base::Pointer, to, 0, 0, kNoBit};
  }
  return at;
}

namespace {

bool fitsInstruction(const Dimension& dimension) {
  return dimension.low == static_cast<int32_t>(dimension.low) && dimension.count() <= UINT32_MAX;
}
int64_t rangeOf(const Dimension& dimension) {
  return static_cast<int64_t>(dimension.count() << 32 | static_cast<uint32_t>(dimension.low));
}

}  // namespace

bool BodyTranslator::loadOfTwo(ExprId id, const Operand* want, Operand& to) {
  const Expr& e = expr(id);
  const IndexExpr& node = e.as<IndexExpr>();
  if (node.indices.count != 2 || isString(e.type) || isAggregate(e.type)) return false;
  const ExprId first = body_->list(node.indices)[0], second = body_->list(node.indices)[1];
  const Scalar type = scalarOf(first);
  if (expr(first).kind == ExprKind::Const || expr(second).kind == ExprKind::Const || type != scalarOf(second) ||
      (type != Scalar::I16 && type != Scalar::I32) || ir::mayFault(*body_, second) ||
      contains(*body_, second, ExprKind::Call))
    return false;
  const TypeInfo& array = info(expr(node.base).type);
  const Dimension &rows = array.dimensions[0], &columns = array.dimensions[1];
  const uint64_t stride = info(array.base).size * columns.count();
  if (!fitsInstruction(rows) || !fitsInstruction(columns) || stride > UINT32_MAX) return false;
  Address base = place(node.base);
  if (base.base == Base::Constant || (base.base == Base::Pointer && base.offset != 0))
    base = {Base::Pointer, pointerTo(base), 0, 0, kNoBit};
  Operand row = inMemory(value(first), type), column = inMemory(value(second), type);
  if (row.mode != column.mode) {
    row = inFrame(row, type);
    column = inFrame(column, type);
  }
  to = target(want);
  emit(loadElementOfTwoHandler(scalarOf(id), type, base.base, row.mode, to.mode), to.ref, base.ref, row.ref,
       indexSite(e, rows), rangeOf(rows));
  emit(haltHandler(), {static_cast<uint32_t>(stride), false}, {}, column.ref, indexSite(e, columns), rangeOf(columns));
  return true;
}

bool BodyTranslator::element(const Expr& e, Element& out) {
  if (e.kind != ExprKind::Index || isString(e.type) || isAggregate(e.type)) return false;
  const std::span<const ExprId> indices = body_->list(e.as<IndexExpr>().indices);
  const Dimension& dimension = info(expr(e.as<IndexExpr>().base).type).dimensions[indices.size() - 1];
  const ExprId last = indices.back();
  if (expr(last).kind == ExprKind::Const) return false;
  if (!fitsInstruction(dimension)) return false;
  out.base = indexed(e, indices.size() - 1);
  if (out.base.base == Base::Constant || out.base.offset != 0) {
    out.base = {Base::Pointer, pointerTo(out.base), 0, 0, kNoBit};
  }
  out.index = indexOperand(last, out.index_type);
  out.range = rangeOf(dimension);
  out.site = indexSite(e, dimension);
  return true;
}

}  // namespace rung::ir::interpreter
