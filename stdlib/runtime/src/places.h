// SPDX-License-Identifier: Apache-2.0
// Places in the memory of two versions of a program, and their paths as text. Called by change_plan.cpp and change.cpp.
// Without memory of its own.
#pragma once

#include <string.h>

#include "rung/change.h"

namespace rung_change_detail {

constexpr uint8_t kNoBit = 255;

// A block, or RUNG_RANGE_AREA + an area; and an offset in it.
struct Place {
  uint32_t memory, offset;
  Place at(uint64_t further) const { return {memory, offset + static_cast<uint32_t>(further)}; }
};

inline bool isArea(uint32_t memory) { return (memory & RUNG_RANGE_AREA) != 0; }

inline uint8_t* addressOf(const rung_context& context, Place place) {
  return isArea(place.memory) ? context.areas[place.memory & ~RUNG_RANGE_AREA] + place.offset
                              : static_cast<uint8_t*>(context.blocks[place.memory]) + place.offset;
}

inline uint8_t bitOf(const rung_field& field) {
  const uint32_t number = field.flags >> RUNG_FIELD_BIT_SHIFT & 15;
  return number == 0 ? kNoBit : static_cast<uint8_t>(number - 1);
}

inline bool isInteger(const rung_type& type) { return type.kind >= RUNG_BYTE && type.kind <= RUNG_ULINT; }

inline uint64_t lengthOf(const rung_dimension& dimension) {
  return dimension.high < dimension.low ? 0 : static_cast<uint64_t>(dimension.high - dimension.low) + 1;
}

inline uint64_t elementsOf(const rung_module& module, const rung_type& array) {
  uint64_t count = 1;
  for (uint32_t d = 0; d < array.count; ++d) count *= lengthOf(*rung_dimension_at(&module, array.first + d));
  return count;
}

// Text that grows and shrinks at its end. What does not fit is cut.
class PathText {
 public:
  PathText(char* to, uint32_t capacity) : to_(to), capacity_(capacity) { cut(0); }

  uint32_t size() const { return size_; }
  const char* text() const { return to_; }
  void cut(uint32_t size) {
    size_ = size;
    if (capacity_ > 0) to_[size_ < capacity_ ? size_ : capacity_ - 1] = 0;
  }
  void add(const char* text) {
    while (*text != 0) put(*text++);
    cut(size_);
  }
  void addField(const char* name) {
    if (size_ > 0) put('.');
    add(name);
  }
  void addIndex(char before, int64_t index) {
    put(before);
    char digits[24];
    char* at = digits + sizeof digits;
    *--at = 0;
    uint64_t left = index < 0 ? uint64_t{0} - static_cast<uint64_t>(index) : static_cast<uint64_t>(index);
    do *--at = static_cast<char>('0' + left % 10);
    while ((left /= 10) != 0);
    if (index < 0) *--at = '-';
    add(at);
  }
  void close() { add("]"); }

 private:
  void put(char c) {
    if (size_ + 1 < capacity_) to_[size_] = c;
    ++size_;
  }

  char* to_;
  uint32_t capacity_, size_ = 0;
};

// `[2,3]` of the element with this number, counted row by row.
inline void addElement(PathText& path, const rung_module& module, const rung_type& array, uint64_t number) {
  uint64_t rows = elementsOf(module, array);
  for (uint32_t d = 0; d < array.count; ++d) {
    const rung_dimension& dimension = *rung_dimension_at(&module, array.first + d);
    rows /= lengthOf(dimension);
    path.addIndex(d == 0 ? '[' : ',', dimension.low + static_cast<int64_t>(number / rows));
    number %= rows;
  }
  path.close();
}

// A copy of a field's row: modules may have longer ones.
inline const rung_field& fieldOf(const rung_module& module, const rung_type& record, uint32_t index) {
  return *rung_field_at(&module, record.first + index);
}

inline const rung_change_tables* tablesOf(const rung_module& module) {
  const rung_extension* const extension = rung_find_extension(&module.extensions, RUNG_CHANGE);
  return extension == nullptr ? nullptr : static_cast<const rung_change_tables*>(extension->data);
}

inline const rung_block_life& lifeOf(const rung_change_tables& tables, uint32_t row) {
  return *static_cast<const rung_block_life*>(rung_row(&tables.blocks, row));
}

// The row of a block; null: it has none.
inline const rung_block_life* lifeOfBlock(const rung_module& module, uint32_t block) {
  const rung_change_tables* const tables = tablesOf(module);
  for (uint32_t i = 0; tables != nullptr && i < tables->blocks.count; ++i)
    if (lifeOf(*tables, i).block == block) return &lifeOf(*tables, i);
  return nullptr;
}

// The block with the pool of __NEW (stdlib/__system/dynamic_memory.st); RUNG_NONE: the program has none.
inline uint32_t poolOf(const rung_module& module) {
  static constexpr char kList[] = "__system_dynamic_memory";
  for (uint32_t i = 0; i < module.blocks.count; ++i) {
    const rung_block_life* const life = lifeOfBlock(module, i);
    const bool is_list = strncmp(module.strings + rung_block_at(&module, i)->name, kList, sizeof kList - 1) == 0;
    const rung_type* const type = life == nullptr || !is_list ? nullptr : rung_type_at(&module, life->type);
    if (type != nullptr && type->count > 0 && strcmp(module.strings + fieldOf(module, *type, 0).name, "pool") == 0)
      return i;
  }
  return RUNG_NONE;
}

// The path of the variable at a place, the innermost one.
void describePlace(PathText& path, const rung_module& module, Place place);

}  // namespace rung_change_detail
