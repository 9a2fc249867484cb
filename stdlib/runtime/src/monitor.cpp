// SPDX-License-Identifier: Apache-2.0
// Values of variables, and forces: see rung/monitor.h.
#include "rung/monitor.h"

#include "rung/values.h"
#include "text.h"

namespace {

bool isString(const rung_type& type) { return type.kind >= RUNG_STRING && type.kind <= RUNG_USTRING; }

uint8_t integerKind(const rung_module& module, const rung_type& type) {
  return type.element != RUNG_NONE ? rung_type_at(&module, type.element)->kind : uint8_t{RUNG_DINT};
}

// The number of an enumeration, which may be signed or not.
int64_t loadNumber(const void* from, uint8_t kind, uint32_t size) {
  uint64_t bits = 0;
  memcpy(&bits, from, size);
  const uint32_t shift = 64 - 8 * size;
  const bool is_signed = kind >= RUNG_SINT && kind <= RUNG_LINT;
  return is_signed ? static_cast<int64_t>(bits << shift) >> shift : static_cast<int64_t>(bits);
}

// Copies a value; a scalar in one access, as others may read it meanwhile.
void copyValue(void* to, const void* from, uint32_t size) {
  switch (size) {
    case 1: memcpy(to, from, 1); break;
    case 2: memcpy(to, from, 2); break;
    case 4: memcpy(to, from, 4); break;
    case 8: memcpy(to, from, 8); break;
    default: memcpy(to, from, size);
  }
}

uint8_t bitOf(const void* byte, uint8_t bit) { return *static_cast<const uint8_t*>(byte) >> bit & 1; }

void setBit(void* byte, uint8_t bit, bool value) {
  const auto mask = static_cast<uint8_t>(1u << bit);
  auto* const at = static_cast<uint8_t*>(byte);
  *at = static_cast<uint8_t>(value ? *at | mask : *at & ~mask);
}

// Writes the value where the variable is. Strings end, whatever the value is.
void store(const rung_variable& variable, void* at, const void* value) {
  const rung_type& type = *variable.type;
  if (variable.bit != 255) return setBit(at, variable.bit, *static_cast<const uint8_t*>(value) != 0);
  copyValue(at, value, type.size);
  const uint32_t unit = type.kind == RUNG_WSTRING ? 2 : 1;
  if (isString(type)) memset(static_cast<char*>(at) + type.length * unit, 0, unit);
}

// The item of an enumeration that `matches`, or null.
template <class Match>
const rung_enum_item* findItem(const rung_module& module, const rung_type& type, Match matches) {
  for (uint32_t i = 0; i < type.count; ++i) {
    const rung_enum_item* const item = rung_enum_item_at(&module, type.first + i);
    if (matches(*item)) return item;
  }
  return nullptr;
}

uint32_t copyText(const char* from, char* text, uint32_t capacity) {
  uint32_t length = 0;
  for (; length < capacity && from[length] != 0; ++length) text[length] = from[length];
  text[length] = 0;
  return length;
}

// The name of the item, or the number where there is none.
uint32_t formatEnum(const rung_module& module, const rung_type& type, const void* at, char* text, uint32_t capacity) {
  const uint8_t kind = integerKind(module, type);
  const int64_t number = loadNumber(at, kind, type.size);
  const rung_enum_item* const item =
      findItem(module, type, [&](const rung_enum_item& of) { return of.value == number; });
  if (item != nullptr) return copyText(module.strings + item->name, text, capacity);
  return rung_format(kind, false, at, text, capacity);
}

// `NULL`, or the address: `16#7FFE10`.
uint32_t formatPointer(const void* at, char* text, uint32_t capacity) {
  uintptr_t address = 0;
  memcpy(&address, at, sizeof address);
  if (address == 0) return copyText("NULL", text, capacity);
  char digits[3 + 2 * sizeof address + 1];
  char* begin = digits + sizeof digits - 1;
  *begin = 0;
  for (; address != 0; address >>= 4) *--begin = "0123456789ABCDEF"[address & 15];
  for (const char* c = "#61"; *c != 0; ++c) *--begin = *c;
  return copyText(begin, text, capacity);
}

// `Green`, `Color#Green`, `Color.Green`, or the number.
rung_access parseEnum(const rung_module& module, const rung_type& type, const char* text, size_t size, void* value) {
  const char* const end = text + size;
  const char* item = text;
  const char* const name = module.strings + type.name;
  for (const char* c = text; c != end && item == text; ++c)
    if ((*c == '#' || *c == '.') && rung_equal_names(text, static_cast<size_t>(c - text), name)) item = c + 1;
  const rung_enum_item* const found = findItem(module, type, [&](const rung_enum_item& of) {
    return rung_equal_names(item, static_cast<size_t>(end - item), module.strings + of.name);
  });
  uint64_t number = 0;
  if (found != nullptr)
    memcpy(&number, &found->value, sizeof number);
  else if (!rung_parse(integerKind(module, type), false, 0, text, size, &number))
    return RUNG_ACCESS_VALUE;
  memcpy(value, &number, type.size);
  return RUNG_ACCESS_OK;
}

// The number of the row of a variable; forces.count: it has none.
uint32_t rowOf(const rung_forces& forces, const rung_variable& variable) {
  uint32_t i = 0;
  while (i < forces.count && !rung_is_same_variable(&forces.rows[i].variable, &variable)) ++i;
  return i;
}

// Where the value of the row, or of the next new one, is; null: there is no room for it.
uint8_t* roomFor(const rung_forces& forces, uint32_t row, const rung_variable& variable) {
  if (row < forces.count) return forces.values + forces.rows[row].value;
  if (row == forces.capacity || variable.type->size > forces.value_capacity - forces.value_bytes) return nullptr;
  return forces.values + forces.value_bytes;
}

void removeRow(rung_forces& forces, uint32_t row) {
  --forces.count;
  memmove(forces.rows + row, forces.rows + row + 1, (forces.count - row) * sizeof forces.rows[0]);
}

// The row, or a new one, becomes the last; its value is set.
void keep(rung_forces& forces, uint32_t row, const rung_variable& variable) {
  uint32_t value = forces.value_bytes;
  if (row < forces.count) {
    value = forces.rows[row].value;
    removeRow(forces, row);
  } else {
    forces.value_bytes += variable.type->size;
  }
  rung_forced& forced = forces.rows[forces.count++];
  forced.variable = variable;
  forced.value = value;
  forced.is_held = 0;
}

}  // namespace

extern "C" {

bool rung_is_same_variable(const rung_variable* one, const rung_variable* other) {
  return one->storage == other->storage && one->bit == other->bit && one->index == other->index &&
         one->pointers == other->pointers && one->type->kind == other->type->kind &&
         one->type->size == other->type->size &&
         memcmp(one->offsets, other->offsets, (one->pointers + 1u) * sizeof one->offsets[0]) == 0;
}

void* rung_address(const rung_context* context, const rung_variable* variable) {
  uint8_t* at = variable->storage == RUNG_IN_AREA ? context->areas[variable->index]
                                                  : static_cast<uint8_t*>(context->blocks[variable->index]);
  at += variable->offsets[0];
  for (uint32_t i = 1; i <= variable->pointers; ++i) {
    uint8_t* target;
    memcpy(&target, at, sizeof target);
    if (target == nullptr) return nullptr;
    at = target + variable->offsets[i];
  }
  return at;
}

bool rung_read_value(const rung_context* context, const rung_variable* variable, void* value, size_t size) {
  const void* const at = rung_address(context, variable);
  if (at == nullptr || size != variable->type->size) return false;
  if (variable->bit != 255)
    *static_cast<uint8_t*>(value) = bitOf(at, variable->bit);
  else
    copyValue(value, at, variable->type->size);
  return true;
}

rung_access rung_is_writable(const rung_variable* variable) {
  if ((variable->flags & RUNG_FIELD_CONSTANT) != 0) return RUNG_ACCESS_CONSTANT;
  if ((variable->flags & RUNG_FIELD_READ_ONLY) != 0) return RUNG_ACCESS_READ_ONLY;
  if (variable->type->kind == RUNG_ARRAY) return RUNG_ACCESS_ARRAY;
  if (variable->type->kind == RUNG_RECORD) return RUNG_ACCESS_RECORD;
  return variable->type->kind >= RUNG_POINTER ? RUNG_ACCESS_POINTER : RUNG_ACCESS_OK;
}

rung_access rung_write_value(const rung_context* context, const rung_variable* variable, const void* value,
                             size_t size) {
  if (const rung_access refused = rung_is_writable(variable)) return refused;
  if (size != variable->type->size) return RUNG_ACCESS_SIZE;
  void* const at = rung_address(context, variable);
  if (at == nullptr) return RUNG_ACCESS_NULL;
  store(*variable, at, value);
  return RUNG_ACCESS_OK;
}

uint32_t rung_text_capacity(const rung_module* module, const rung_variable* variable) {
  const rung_type& type = *variable->type;
  if (isString(type)) return 5 * type.length + 2;
  uint32_t capacity = RUNG_FORMATTED_SCALAR;
  if (type.kind != RUNG_ENUM) return capacity;
  findItem(*module, type, [&](const rung_enum_item& item) {
    const size_t length = strlen(module->strings + item.name);
    if (length > capacity) capacity = static_cast<uint32_t>(length);
    return false;
  });
  return capacity;
}

uint32_t rung_format_value(const rung_module* module, const rung_variable* variable, const void* value, char* text,
                           uint32_t capacity) {
  const rung_type& type = *variable->type;
  text[0] = 0;
  if (type.kind == RUNG_ARRAY || type.kind == RUNG_RECORD || type.kind > RUNG_POINTER) return 0;
  if (type.kind == RUNG_ENUM) return formatEnum(*module, type, value, text, capacity);
  if (type.kind == RUNG_POINTER) return formatPointer(value, text, capacity);
  // Other variables may overlap the final zero of a string.
  if (isString(type)) return rung_format_string(type.kind, value, type.length, text, capacity);
  return rung_format(type.kind, type.is_signed != 0, value, text, capacity);
}

uint32_t rung_read_text(const rung_context* context, const rung_variable* variable, char* text, uint32_t capacity) {
  const void* const at = rung_address(context, variable);
  text[0] = 0;
  if (at == nullptr) return 0;
  const uint8_t bit = variable->bit != 255 ? bitOf(at, variable->bit) : uint8_t{0};
  return rung_format_value(context->module, variable, variable->bit != 255 ? &bit : at, text, capacity);
}

rung_access rung_parse_value(const rung_module* module, const rung_variable* variable, const char* text, size_t size,
                             void* value) {
  if (const rung_access refused = rung_is_writable(variable)) return refused;
  const rung_type& type = *variable->type;
  if (type.kind == RUNG_ENUM) return parseEnum(*module, type, text, size, value);
  return rung_parse(type.kind, type.is_signed != 0, type.length, text, size, value) ? RUNG_ACCESS_OK
                                                                                    : RUNG_ACCESS_VALUE;
}

rung_access rung_write_text(const rung_context* context, const rung_variable* variable, const char* text, size_t size) {
  if (const rung_access refused = rung_is_writable(variable)) return refused;
  void* const at = rung_address(context, variable);
  if (at == nullptr) return RUNG_ACCESS_NULL;
  if (variable->bit == 255) return rung_parse_value(context->module, variable, text, size, at);
  uint8_t value = 0;
  const rung_access parsed = rung_parse_value(context->module, variable, text, size, &value);
  if (parsed == RUNG_ACCESS_OK) setBit(at, variable->bit, value != 0);
  return parsed;
}

rung_access rung_force(rung_forces* forces, const rung_variable* variable, const void* value, size_t size) {
  if (const rung_access refused = rung_is_writable(variable)) return refused;
  if (size != variable->type->size) return RUNG_ACCESS_SIZE;
  const uint32_t row = rowOf(*forces, *variable);
  uint8_t* const room = roomFor(*forces, row, *variable);
  if (room == nullptr) return RUNG_ACCESS_FULL;
  memcpy(room, value, size);
  keep(*forces, row, *variable);
  return RUNG_ACCESS_OK;
}

rung_access rung_force_text(rung_forces* forces, const rung_module* module, const rung_variable* variable,
                            const char* text, size_t size) {
  if (const rung_access refused = rung_is_writable(variable)) return refused;
  const uint32_t row = rowOf(*forces, *variable);
  uint8_t* const room = roomFor(*forces, row, *variable);
  if (room == nullptr) return RUNG_ACCESS_FULL;
  const rung_access parsed = rung_parse_value(module, variable, text, size, room);
  if (parsed == RUNG_ACCESS_OK) keep(*forces, row, *variable);
  return parsed;
}

bool rung_unforce(rung_forces* forces, const rung_variable* variable) {
  const uint32_t row = rowOf(*forces, *variable);
  if (row == forces->count) return false;
  const uint32_t value = forces->rows[row].value, size = variable->type->size;
  memmove(forces->values + value, forces->values + value + size, forces->value_bytes - value - size);
  forces->value_bytes -= size;
  removeRow(*forces, row);
  for (uint32_t i = 0; i < forces->count; ++i)
    if (forces->rows[i].value > value) forces->rows[i].value -= size;
  return true;
}

void rung_apply_forces(const rung_context* context, const rung_forces* forces) {
  for (uint32_t i = 0; i < forces->count; ++i) {
    const rung_forced& row = forces->rows[i];
    void* const at = row.is_held != 0 ? nullptr : rung_address(context, &row.variable);
    if (at != nullptr) store(row.variable, at, forces->values + row.value);
  }
}

}  // extern "C"
