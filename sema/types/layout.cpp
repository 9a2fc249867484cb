// Layout of types in memory: natural alignment, 64-bit scalars on 8, arrays row-major, strings with their NUL, in-outs
// as pointers. An empty record takes one byte, as in C++, so that offsets agree.
#include <algorithm>

#include "sema/types/types.h"

namespace rung::types {

namespace {

constexpr uint64_t kMaxSize = uint64_t{1} << 31;

uint64_t alignUp(uint64_t value, uint32_t align) { return (value + align - 1) / align * align; }

}  // namespace

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
  } else if (info.kind == TypeKind::Array) {
    fits = layout(info.base);
    const TypeInfo& element = types_[info.base.index];
    info.align = element.align;
    info.size = info.dimensions.empty() ? 0 : element.size;
    for (const Dimension& dimension : info.dimensions) {
      const uint64_t count = std::max<uint64_t>(dimension.count(), 1);  // C++ has no array without elements
      if (info.size > kMaxSize / count) {
        fits = false;
        break;
      }
      info.size *= count;
    }
  } else if (info.kind == TypeKind::Record) {
    uint64_t end = 0;
    uint32_t align = 1;
    for (Field& field : info.fields) {
      uint64_t size = pointer_size_;
      uint32_t field_align = pointer_size_;
      if (!field.by_reference) {
        fits = layout(field.type) && fits;
        size = types_[field.type.index].size;
        field_align = types_[field.type.index].align;
      }
      const uint64_t offset = info.record_kind == RecordKind::Union ? field.given_offset : alignUp(end, field_align);
      if (offset + size >= kMaxSize) {
        fits = false;
        break;
      }
      field.offset = static_cast<uint32_t>(offset);
      if (offset + size > end) end = offset + size;
      if (field_align > align) align = field_align;
    }
    info.align = align;
    info.size = end == 0 ? align : alignUp(end, align);
  }  // scalars and strings are laid out from the start; literal and generic types have no memory
  if (!fits || info.size >= kMaxSize) {
    info.size = kMaxSize;
    return false;
  }
  return true;
}

}  // namespace rung::types
