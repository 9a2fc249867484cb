// SPDX-License-Identifier: Apache-2.0
// The path of a place: see places.h.
#include "places.h"

#include "rung/monitor.h"

namespace rung_change_detail {
namespace {

// Goes from a record or array to the part that has the offset. False: there is none.
bool descend(PathText& path, const rung_module& module, const rung_type*& type, uint32_t& offset) {
  if (type->kind == RUNG_ARRAY) {
    const rung_type& element = *rung_type_at(&module, type->element);
    if (element.size == 0 || offset >= type->size) return false;
    addElement(path, module, *type, offset / element.size);
    offset %= element.size;
    type = &element;
    return true;
  }
  if (type->kind != RUNG_RECORD) return false;
  for (uint32_t i = 0; i < type->count; ++i) {
    const rung_field& field = fieldOf(module, *type, i);
    const rung_type& is = *rung_type_at(&module, field.type);
    const bool is_pointer = (field.flags & RUNG_FIELD_BY_REFERENCE) != 0;
    const uint32_t size = is_pointer ? module.pointer_size : is.size;
    if (offset < field.offset || offset - field.offset >= size) continue;
    offset -= field.offset;
    if ((field.flags & RUNG_FIELD_BASE) == 0) path.addField(module.strings + field.name);
    type = &is;
    return !is_pointer;
  }
  return false;
}

}  // namespace

void describePlace(PathText& path, const rung_module& module, Place place) {
  constexpr uint32_t kCapacity = 256;
  char root[kCapacity];
  for (uint32_t i = 0; i < module.symbols.count; ++i) {
    const rung_symbol& symbol = *rung_symbol_at(&module, i);
    const bool in_area = symbol.storage == RUNG_IN_AREA;
    const rung_type* type = rung_type_at(&module, symbol.type);
    const bool has = symbol.index == (place.memory & ~RUNG_RANGE_AREA) && in_area == isArea(place.memory) &&
                     place.offset >= symbol.offset && place.offset - symbol.offset < type->size;
    if (!has || rung_path_of_symbol(&module, i, root, kCapacity) == 0) continue;
    path.add(root);
    uint32_t offset = place.offset - symbol.offset;
    while (descend(path, module, type, offset)) {
    }
    return;
  }
  const bool in_area = isArea(place.memory);
  path.add(in_area ? module.strings + rung_area_at(&module, place.memory & ~RUNG_RANGE_AREA)->prefix
                   : module.strings + rung_block_at(&module, place.memory)->name);
}

}  // namespace rung_change_detail
