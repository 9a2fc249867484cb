// SPDX-License-Identifier: Apache-2.0
// rung_find_axes of rung/motion.h: walks the symbol map for records of the type RUNG_DRIVE. Without memory of its own.
#include "rung/motion.h"

#include <string.h>

#include "text.h"

namespace {

// The path so far, cut where it gets too long.
struct Path {
  char text[sizeof(rung_axis::name)];
  size_t length;

  void append(const char* name) {
    while (*name != 0 && length + 1 < sizeof text) text[length++] = *name++;
    text[length] = 0;
  }
  void append(int64_t number) {
    char digits[24];
    size_t at = sizeof digits - 1;
    digits[at] = 0;
    uint64_t left = number < 0 ? 0 - static_cast<uint64_t>(number) : static_cast<uint64_t>(number);
    do {
      digits[--at] = static_cast<char>('0' + left % 10);
      left /= 10;
    } while (left != 0);
    if (number < 0) digits[--at] = '-';
    append(digits + at);
  }
};

class Walk {
 public:
  Walk(const rung_module& module, rung_axis* axes, uint32_t capacity)
      : module_(module), axes_(axes), capacity_(capacity) {}

  uint32_t run() {
    for (uint32_t i = 0; i < module_.symbols.count; ++i) {
      const rung_symbol& symbol = *rung_symbol_at(&module_, i);
      if (symbol.storage != RUNG_IN_BLOCK || (symbol.flags & RUNG_FIELD_BY_REFERENCE) != 0) continue;
      Path path = {};
      path.append(module_.strings + symbol.name);
      block_ = symbol.index;
      visit(*rung_type_at(&module_, symbol.type), symbol.offset, path, path);
    }
    return count_;
  }

 private:
  // `holder` is the path of the record that has it: the axis.
  void visit(const rung_type& type, uint32_t offset, const Path& path, const Path& holder) {
    if (type.kind == RUNG_ARRAY) return visitElements(type, offset, path);
    if (type.kind != RUNG_RECORD) return;
    if (rung_equal_names("RUNG_DRIVE", strlen("RUNG_DRIVE"), module_.strings + type.name)) return found(offset, holder);
    for (uint32_t i = 0; i < type.count; ++i) {
      const rung_field& field = *rung_field_at(&module_, type.first + i);
      const rung_type& of = *rung_type_at(&module_, field.type);
      if ((field.flags & RUNG_FIELD_BY_REFERENCE) != 0 || (of.kind != RUNG_RECORD && of.kind != RUNG_ARRAY)) continue;
      Path inner = path;
      if ((field.flags & RUNG_FIELD_BASE) == 0) {
        inner.append(".");
        inner.append(module_.strings + field.name);
      }
      visit(of, offset + field.offset, inner, path);
    }
  }

  void visitElements(const rung_type& type, uint32_t offset, const Path& path) {
    const rung_type& element = *rung_type_at(&module_, type.element);
    if ((element.kind != RUNG_RECORD && element.kind != RUNG_ARRAY) || element.size == 0) return;
    const uint32_t elements = type.size / element.size;
    for (uint32_t i = 0; i < elements; ++i) {
      Path inner = path;
      appendIndices(type, i, inner);
      const uint32_t before = count_;
      visit(element, offset + i * element.size, inner, inner);
      if (count_ == before) return;  // no element has one
    }
  }

  // The last index counts fastest.
  void appendIndices(const rung_type& type, uint32_t element, Path& path) const {
    for (uint32_t d = 0; d < type.count; ++d) {
      uint64_t below = 1;
      for (uint32_t inner = d + 1; inner < type.count; ++inner) below *= extent(type, inner);
      path.append(d == 0 ? "[" : ",");
      path.append(rung_dimension_at(&module_, type.first + d)->low +
                  static_cast<int64_t>(element / below % extent(type, d)));
    }
    path.append("]");
  }
  uint64_t extent(const rung_type& type, uint32_t d) const {
    const rung_dimension& dimension = *rung_dimension_at(&module_, type.first + d);
    return static_cast<uint64_t>(dimension.high - dimension.low) + 1;
  }

  void found(uint32_t offset, const Path& path) {
    if (count_ < capacity_) {
      memcpy(axes_[count_].name, path.text, sizeof path.text);
      axes_[count_].block = block_;
      axes_[count_].offset = offset;
    }
    ++count_;
  }

  const rung_module& module_;
  rung_axis* axes_;
  uint32_t capacity_, count_ = 0, block_ = 0;
};

}  // namespace

extern "C" uint32_t rung_find_axes(const rung_module* module, rung_axis* axes, uint32_t capacity) {
  return Walk(*module, axes, capacity).run();
}
