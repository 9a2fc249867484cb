// SPDX-License-Identifier: Apache-2.0
// Layout of types in memory: natural alignment where no pack mode says less, 64-bit scalars on 8, arrays row-major,
// strings with their NUL, in-outs as pointers. An empty record takes one byte, as in C++, so that offsets agree.
#include <algorithm>

#include "sema/types/types.h"

namespace rung::types {

namespace {

constexpr uint64_t kMaxSize = uint64_t{1} << 31;

uint64_t alignUp(uint64_t value, uint32_t align) { return (value + align - 1) / align * align; }

}  // namespace

uint32_t TypeTable::fieldAlign(const Field& field) const {
  const uint32_t least = field.by_reference ? 1 : types_[field.type.index].least_align;
  const uint32_t natural = field.by_reference ? pointer_size_ : types_[field.type.index].align;
  return field.pack == 0 ? natural : std::max(least, std::min<uint32_t>(natural, field.pack));
}

// The records in a variable of this type lie at addresses that are only so much aligned.
void TypeTable::place(TypeId id, uint32_t align) {
  TypeInfo& info = types_[id.index];
  if (info.kind == TypeKind::Alias || info.kind == TypeKind::Array) return place(info.base, align);
  if (info.kind != TypeKind::Record || info.placed_align <= align) return;
  info.placed_align = align;
  for (const Field& field : info.fields)
    if (!field.by_reference) place(field.type, align);
}

bool TypeTable::layoutArray(TypeInfo& info) {
  const bool fits = layout(info.base);
  const TypeInfo& element = types_[info.base.index];
  info.align = element.align;
  info.least_align = element.least_align;
  info.size = info.dimensions.empty() ? 0 : element.size;
  for (const Dimension& dimension : info.dimensions) {
    const uint64_t count = std::max<uint64_t>(dimension.count(), 1);  // C++ has no array without elements
    if (info.size > kMaxSize / count) return false;
    info.size *= count;
  }
  return fits;
}

bool TypeTable::layoutRecord(TypeInfo& info) {
  bool fits = true;
  uint64_t end = 0;
  uint32_t align = 1;
  for (Field& field : info.fields) {
    uint64_t size = pointer_size_;
    if (!field.by_reference) {
      fits = layout(field.type) && fits;
      size = types_[field.type.index].size;
      info.least_align = std::max(info.least_align, types_[field.type.index].least_align);
    }
    const uint32_t field_align = fieldAlign(field);
    const uint64_t offset = info.record_kind == RecordKind::Union ? field.given_offset : alignUp(end, field_align);
    if (offset + size >= kMaxSize) {
      fits = false;
      break;
    }
    field.offset = static_cast<uint32_t>(offset);
    end = std::max(end, offset + size);
    align = std::max(align, field_align);
  }
  info.align = info.placed_align = align;
  info.size = end == 0 ? align : alignUp(end, align);
  if (info.record_kind != RecordKind::Struct && info.record_kind != RecordKind::Union) info.least_align = align;
  for (const Field& field : info.fields) {
    if (field.pack == 0 || (!field.by_reference && fieldAlign(field) == types_[field.type.index].align)) continue;
    has_misaligned = true;
    if (!field.by_reference) place(field.type, fieldAlign(field));
  }
  return fits;
}

bool TypeTable::layout(TypeId id) {
  TypeInfo& info = types_[id.index];  // types never move
  if (info.laid_out) return info.size < kMaxSize;
  info.laid_out = true;
  bool fits = true;
  if (info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference) {
    info.size = info.align = pointer_size_;
  } else if (info.kind == TypeKind::Enum || info.kind == TypeKind::Subrange || info.kind == TypeKind::Alias) {
    fits = layout(info.base);
    info.size = types_[info.base.index].size;
    info.align = types_[info.base.index].align;
    info.least_align = types_[info.base.index].least_align;
  } else if (info.kind == TypeKind::Array) {
    fits = layoutArray(info);
  } else if (info.kind == TypeKind::Record) {
    fits = layoutRecord(info);
  }  // scalars and strings are laid out from the start; literal and generic types have no memory
  if (fits && info.size < kMaxSize) return true;
  info.size = kMaxSize;
  return false;
}

}  // namespace rung::types
