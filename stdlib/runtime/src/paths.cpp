// SPDX-License-Identifier: Apache-2.0
// Paths of variables: see rung/monitor.h.
#include "rung/monitor.h"
#include "text.h"

namespace {

constexpr uint32_t kMostPrefixes = 4;  // `Config.Resource.`, `Config.Namespace.List.`

constexpr rung_type elementary(rung_type_kind kind, uint32_t size) {
  return {static_cast<uint8_t>(kind), 0, 0, 0, size, RUNG_NONE, 0, 0, 0};
}
// Types of addresses and bits, which need not be in the module. By the power of two that is their size.
constexpr rung_type kBool = elementary(RUNG_BOOL, 1);
constexpr rung_type kBitStrings[] = {elementary(RUNG_BYTE, 1), elementary(RUNG_WORD, 2), elementary(RUNG_DWORD, 4),
                                     elementary(RUNG_LWORD, 8)};

bool isNameCharacter(char c) {
  return c == '_' || (c >= '0' && c <= '9') || (rung_lower(c) >= 'a' && rung_lower(c) <= 'z') ||
         static_cast<unsigned char>(c) >= 0x80 || c == '%';
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// The decimal number at the front; false: there is none, or it has more than 64 bits.
bool takeNumber(rung_path& path, uint64_t& number) {
  const char* const begin = path.at;
  for (number = 0; path.at != path.end && isDigit(*path.at); ++path.at) {
    const auto digit = static_cast<uint64_t>(*path.at - '0');
    if (number > (UINT64_MAX - digit) / 10) return false;
    number = number * 10 + digit;
  }
  return path.at != begin;
}

size_t sizeOf(const rung_path& path) { return static_cast<size_t>(path.end - path.at); }

// ---- names

// The symbols of a module, or the fields of one record of it.
struct Scope {
  const rung_names* names;  // null: the module has none
  uint32_t first, count;    // indices
  uint32_t base;            // of the rows in rung_names: what is added to the index
};

const rung_names* namesOf(const rung_module& module) {
  const rung_extension* const extension = rung_find_extension(&module.extensions, RUNG_NAMES);
  return extension == nullptr ? nullptr : static_cast<const rung_names*>(extension->data);
}

uint32_t slotAt(const rung_table& slots, uint32_t index) {
  const void* const row = rung_row(&slots, index);
  return slots.row_size == 2 ? *static_cast<const uint16_t*>(row) : *static_cast<const uint32_t*>(row);
}

// The first index of the scope, by the hash of its name, that matches; RUNG_NONE: none does.
template <class Match>
uint32_t findIn(const Scope& scope, uint32_t hash, Match matches) {
  if (scope.names == nullptr) {
    for (uint32_t i = scope.first; i < scope.first + scope.count; ++i)
      if (matches(i)) return i;
    return RUNG_NONE;
  }
  const rung_table& slots = scope.names->slots;
  uint32_t at = rung_name_slot(hash, slots.count);
  for (uint32_t turn = 0; turn < slots.count; ++turn) {
    const uint32_t row = slotAt(slots, at);
    if (row == 0) return RUNG_NONE;
    const uint32_t index = row - 1 - scope.base;
    if (index - scope.first < scope.count && matches(index)) return index;
    if (++at == slots.count) at = 0;
  }
  return RUNG_NONE;
}

// `before` is what the path has in front of the symbol's name: nothing, `Config.Resource.` or `Resource.`.
bool fitsPrefix(const rung_module& module, const rung_symbol& symbol, const char* before, size_t size) {
  if (size == 0) return true;
  const char* const prefix = module.strings + symbol.path;
  const size_t length = strlen(prefix);
  if (length < size || (length > size && prefix[length - size - 1] != '.')) return false;
  return rung_equal_names(before, size, prefix + length - size);
}

// The longest name of a symbol that begins at `begin`; `end` is after it.
uint32_t findSymbolAt(const rung_module& module, const Scope& all, const rung_path& path, const char* begin,
                      const char*& end) {
  const auto before = static_cast<size_t>(begin - path.at);
  uint32_t found = RUNG_NONE, hash = rung_name_seed(RUNG_NONE);
  for (const char* at = begin; at != path.end;) {
    for (; at != path.end && isNameCharacter(*at); ++at) hash = rung_name_hash(hash, *at);
    const uint32_t symbol = findIn(all, hash, [&](uint32_t i) {
      const rung_symbol& row = *rung_symbol_at(&module, i);
      return rung_equal_names(begin, static_cast<size_t>(at - begin), module.strings + row.name) &&
             fitsPrefix(module, row, path.at, before);
    });
    if (symbol != RUNG_NONE) {
      found = symbol;
      end = at;
    }
    if (at == path.end || *at != '.') break;
    hash = rung_name_hash(hash, *at++);
  }
  return found;
}

// The symbol with the longest path at the front.
bool findSymbol(const rung_module& module, rung_path& path, rung_variable& variable) {
  const Scope all{namesOf(module), 0, module.symbols.count, 0};
  const char* end = path.at;
  uint32_t found = RUNG_NONE;
  const char* begin = path.at;
  for (uint32_t prefixes = 0; prefixes <= kMostPrefixes; ++prefixes) {
    const char* its_end = path.at;
    const uint32_t symbol = findSymbolAt(module, all, path, begin, its_end);
    if (symbol != RUNG_NONE && its_end > end) {
      found = symbol;
      end = its_end;
    }
    while (begin != path.end && isNameCharacter(*begin)) ++begin;
    if (begin == path.end || *begin++ != '.') break;
  }
  if (found == RUNG_NONE || end == path.at) return false;
  rung_variable_of_symbol(&module, found, &variable);
  path.at = end;
  path.detail = found;
  return true;
}

void setFlags(rung_variable& variable, uint32_t flags) {
  variable.flags = flags;
  if ((flags & RUNG_FIELD_BIT) != 0) variable.bit = static_cast<uint8_t>((flags >> RUNG_FIELD_BIT_SHIFT & 15) - 1);
}

bool addPointer(rung_variable& variable) {
  if (variable.pointers == RUNG_VARIABLE_POINTERS) return false;
  variable.offsets[++variable.pointers] = 0;
  return true;
}

// The memory of a field.
void enterField(const rung_module& module, const rung_field& field, rung_variable& variable) {
  variable.type = rung_type_at(&module, field.type);
  variable.offsets[variable.pointers] += field.offset;
}

// ---- addresses

// A part of an area; `bit` is 255 where it is not a BOOL.
rung_path_error findPlace(const rung_module& module, uint32_t area, uint64_t byte, const rung_type& type, uint8_t bit,
                          rung_path& path, rung_variable& variable) {
  path.detail = area;
  if (byte + type.size > rung_area_at(&module, area)->size) return RUNG_PATH_OUTSIDE;
  variable.type = &type;
  variable.flags = 0;
  variable.storage = RUNG_IN_AREA;
  variable.bit = bit;
  variable.pointers = 0;
  variable.index = area;
  variable.offsets[0] = static_cast<uint32_t>(byte);
  path.at = path.end;
  path.detail = RUNG_NONE;
  return RUNG_PATH_OK;
}

// The area whose prefix the path begins with; RUNG_NONE: none.
uint32_t findArea(const rung_module& module, rung_path& rest) {
  for (uint32_t i = 0; i < module.areas.count; ++i) {
    const char* const prefix = module.strings + rung_area_at(&module, i)->prefix;
    const size_t size = strlen(prefix);
    if (size == 0 || size > sizeOf(rest) || !rung_equal_names(rest.at, size, prefix)) continue;
    rest.at += size;
    return i;
  }
  return RUNG_NONE;
}

// `%IX0.3`, `%QB4`, `%MW6`, `%IX5` (byte 0, bit 5): the area itself, declared or not.
rung_path_error findAddress(const rung_module& module, rung_path& path, rung_variable& variable) {
  rung_path rest = path;
  const uint32_t area = findArea(module, rest);
  if (area == RUNG_NONE) return RUNG_PATH_ADDRESS;
  const rung_type* type = &kBool;
  if (rest.at != rest.end && rung_lower(*rest.at) >= 'a') {
    static const char kWidths[] = "xbwdl";
    const char* const width = static_cast<const char*>(memchr(kWidths, rung_lower(*rest.at++), 5));
    if (width == nullptr) return RUNG_PATH_WIDTH;
    if (width != kWidths) type = &kBitStrings[width - kWidths - 1];
  }
  uint64_t byte = 0, bit = 0;
  if (!takeNumber(rest, byte)) return RUNG_PATH_ADDRESS;
  if (type == &kBool && rest.at != rest.end && *rest.at == '.') {
    ++rest.at;
    if (!takeNumber(rest, bit) || bit > 7) return RUNG_PATH_ADDRESS;
  } else if (type == &kBool) {
    bit = byte % 8;
    byte /= 8;
  }
  if (rest.at != rest.end) return RUNG_PATH_ADDRESS;
  if (byte < UINT32_MAX) byte *= type->size;  // %QW2 is the bytes 4 and 5
  return findPlace(module, area, byte, *type, type == &kBool ? static_cast<uint8_t>(bit) : uint8_t{255}, path,
                   variable);
}

// `9056` and `9056.17`: words and bits of the NCT ladder's memory, %ND9056 and %NX36226.1. False: not of this form.
bool findNctAddress(const rung_module& module, rung_path& path, rung_variable& variable, rung_path_error& error) {
  const size_t size = sizeOf(path);
  if (size != 4 && (size != 7 || path.at[4] != '.')) return false;
  for (size_t i = 0; i < size; ++i)
    if (i != 4 && !isDigit(path.at[i])) return false;
  rung_path rest = path, area_path = {"%N", nullptr, 0};
  area_path.end = area_path.at + 2;
  uint64_t word = 0, bit = 0;
  takeNumber(rest, word);
  if (size == 7) {
    ++rest.at;
    takeNumber(rest, bit);
    if (bit > 31) return false;
  }
  const uint32_t area = findArea(module, area_path);
  error = RUNG_PATH_ADDRESS;
  if (area == RUNG_NONE) return true;
  const uint64_t byte = word * 4 + bit / 8;
  error = size == 4 ? findPlace(module, area, byte, kBitStrings[2], 255, path, variable)
                    : findPlace(module, area, byte, kBool, static_cast<uint8_t>(bit % 8), path, variable);
  return true;
}

rung_path_error findRoot(const rung_module& module, rung_path& path, rung_variable& variable) {
  if (findSymbol(module, path, variable)) return RUNG_PATH_OK;
  if (path.at != path.end && *path.at == '%') return findAddress(module, path, variable);
  rung_path_error error = RUNG_PATH_UNKNOWN;
  findNctAddress(module, path, variable, error);
  return error;
}

// ---- steps

rung_path_error stepToTarget(const rung_module& module, rung_path& path, rung_variable& variable) {
  if (variable.type->kind != RUNG_POINTER) return RUNG_PATH_NO_POINTER;
  if (!addPointer(variable)) return RUNG_PATH_DEPTH;
  variable.type = rung_type_at(&module, variable.type->element);
  ++path.at;
  path.detail = RUNG_NONE;
  return RUNG_PATH_OK;
}

void takeBlanks(rung_path& path) {
  while (path.at != path.end && *path.at == ' ') ++path.at;
}

// The index of one dimension, from 0; after it and blanks `rest` ends.
rung_path_error takeIndex(rung_path& rest, const rung_dimension& dimension, uint64_t& index) {
  takeBlanks(rest);
  const bool is_negative = rest.at != rest.end && *rest.at == '-';
  if (is_negative) ++rest.at;
  uint64_t magnitude = 0;
  if (!takeNumber(rest, magnitude) || magnitude > uint64_t{INT64_MAX} + (is_negative ? 1 : 0)) return RUNG_PATH_INDEX;
  takeBlanks(rest);
  if (rest.at != rest.end) return RUNG_PATH_INDEX;
  const auto number = static_cast<int64_t>(is_negative ? 0 - magnitude : magnitude);
  if (number < dimension.low || number > dimension.high) return RUNG_PATH_RANGE;
  index = static_cast<uint64_t>(number) - static_cast<uint64_t>(dimension.low);
  return RUNG_PATH_OK;
}

rung_path_error stepToElement(const rung_module& module, rung_path& path, rung_variable& variable) {
  const rung_type& type = *variable.type;
  if (type.kind != RUNG_ARRAY) return RUNG_PATH_NO_ARRAY;
  const char* const close = static_cast<const char*>(memchr(path.at, ']', sizeOf(path)));
  if (close == nullptr) return RUNG_PATH_BRACKET;
  uint64_t element = 0;
  rung_path rest{path.at + 1, close, 0};
  takeBlanks(rest);
  uint32_t written = rest.at == close ? 0 : 1;
  for (const char* c = rest.at; c != close; ++c) written += *c == ',' ? 1 : 0;
  if (written != type.count) return RUNG_PATH_DIMENSIONS;
  for (uint32_t d = 0; d < type.count; ++d) {
    const rung_dimension& dimension = *rung_dimension_at(&module, type.first + d);
    const char* const comma = static_cast<const char*>(memchr(rest.at, ',', static_cast<size_t>(close - rest.at)));
    rest.end = comma != nullptr ? comma : close;
    uint64_t index = 0;
    path.detail = d;
    if (const rung_path_error error = takeIndex(rest, dimension, index)) return error;
    element = element * (static_cast<uint64_t>(dimension.high) - static_cast<uint64_t>(dimension.low) + 1) + index;
    rest.at = rest.end + (comma != nullptr ? 1 : 0);
  }
  variable.type = rung_type_at(&module, type.element);
  variable.offsets[variable.pointers] += static_cast<uint32_t>(element * variable.type->size);
  path.at = close + 1;
  path.detail = RUNG_NONE;
  return RUNG_PATH_OK;
}

// `3` or `%X3` of an integer or bit string.
rung_path_error stepToBit(rung_path& path, const rung_path& name, rung_variable& variable) {
  rung_path digits = name;
  if (sizeOf(name) > 2 && name.at[0] == '%' && rung_lower(name.at[1]) == 'x') digits.at += 2;
  uint64_t bit = 0;
  if (!takeNumber(digits, bit) || digits.at != name.end || bit >= uint64_t{variable.type->size} * 8)
    return RUNG_PATH_NO_BIT;
  variable.type = &kBool;
  variable.offsets[variable.pointers] += static_cast<uint32_t>(bit / 8);  // little-endian
  variable.bit = static_cast<uint8_t>(bit % 8);
  path.at = name.end;
  path.detail = RUNG_NONE;
  return RUNG_PATH_OK;
}

uint32_t findField(const rung_module& module, const rung_type& record, const rung_path& name) {
  uint32_t hash = rung_name_seed(record.first);
  for (const char* c = name.at; c != name.end; ++c) hash = rung_name_hash(hash, *c);
  return findIn({namesOf(module), record.first, record.count, module.symbols.count}, hash, [&](uint32_t i) {
    const rung_field& field = *rung_field_at(&module, i);
    return (field.flags & RUNG_FIELD_BASE) == 0 && rung_equal_names(name.at, sizeOf(name), module.strings + field.name);
  });
}

// The block that a record extends: its memory is in that of the record. Null: none.
const rung_field* baseOf(const rung_module& module, const rung_type& record) {
  for (uint32_t i = 0; i < record.count; ++i) {
    const rung_field* const field = rung_field_at(&module, record.first + i);
    if ((field->flags & RUNG_FIELD_BASE) != 0) return field;
  }
  return nullptr;
}

// A field of the record, its own or inherited.
rung_path_error stepToField(const rung_module& module, rung_path& path, const rung_path& name,
                            rung_variable& variable) {
  if (variable.type->kind != RUNG_RECORD) return RUNG_PATH_NO_RECORD;
  rung_variable inside = variable;
  for (;;) {
    const uint32_t index = findField(module, *inside.type, name);
    if (index != RUNG_NONE) {
      const rung_field& field = *rung_field_at(&module, index);
      enterField(module, field, inside);
      setFlags(inside, field.flags);
      if ((field.flags & RUNG_FIELD_BY_REFERENCE) != 0 && !addPointer(inside)) return RUNG_PATH_DEPTH;
      variable = inside;
      path.at = name.end;
      path.detail = index;
      return RUNG_PATH_OK;
    }
    const rung_field* const base = baseOf(module, *inside.type);
    if (base == nullptr) return RUNG_PATH_NO_FIELD;
    enterField(module, *base, inside);
  }
}

rung_path_error stepToMember(const rung_module& module, rung_path& path, rung_variable& variable) {
  rung_path name{path.at + 1, path.at + 1, 0};
  while (name.end != path.end && isNameCharacter(*name.end)) ++name.end;
  const bool has_bits = variable.type->kind >= RUNG_BYTE && variable.type->kind <= RUNG_ULINT && variable.bit == 255;
  return has_bits ? stepToBit(path, name, variable) : stepToField(module, path, name, variable);
}

// ---- lists

class Walk {
 public:
  Walk(const rung_module& module, char* path, uint32_t capacity, rung_visit visit, void* data)
      : module_(module), path_(path), capacity_(capacity), visit_(visit), data_(data) {}

  // `size`: of the path so far. False: the visitor has ended it.
  bool visit(const rung_variable& variable, uint32_t size, const rung_type* owner, const rung_field* field) {
    const rung_part part{path_, size, &variable, owner, field};
    const rung_walk wanted = visit_(data_, &part);
    if (wanted != RUNG_WALK_ENTER) return wanted != RUNG_WALK_END;
    if (variable.type->kind == RUNG_RECORD) return visitFields(variable, size);
    return variable.type->kind != RUNG_ARRAY || visitElements(variable, size);
  }

 private:
  // Appends to the path at `size`; false: there is no room.
  bool append(uint32_t& size, const char* text) {
    const size_t length = strlen(text);
    if (length >= capacity_ - size) return false;
    memcpy(path_ + size, text, length + 1);
    size += static_cast<uint32_t>(length);
    return true;
  }
  bool append(uint32_t& size, int64_t number) {
    char digits[21];
    char* at = digits + sizeof digits - 1;
    *at = 0;
    auto rest = number < 0 ? 0 - static_cast<uint64_t>(number) : static_cast<uint64_t>(number);
    do {
      *--at = static_cast<char>('0' + rest % 10);
      rest /= 10;
    } while (rest != 0);
    if (number < 0) *--at = '-';
    return append(size, at);
  }

  bool visitFields(const rung_variable& variable, uint32_t size) {
    const rung_type& type = *variable.type;
    for (uint32_t i = 0; i < type.count; ++i) {
      const rung_field& field = *rung_field_at(&module_, type.first + i);
      rung_variable part = variable;
      enterField(module_, field, part);
      setFlags(part, field.flags);
      uint32_t its_size = size;
      if ((field.flags & RUNG_FIELD_BASE) == 0 &&
          (!append(its_size, ".") || !append(its_size, module_.strings + field.name)))
        continue;
      if ((field.flags & RUNG_FIELD_BY_REFERENCE) != 0 && !addPointer(part)) continue;
      if (!visit(part, its_size, &type, &field)) return false;
      path_[size] = 0;
    }
    return true;
  }

  // `number`: of the element, the last index counting fastest.
  bool appendIndices(uint32_t& size, const rung_type& array, uint64_t number) {
    uint64_t below = 1;  // elements for each index of the dimension
    for (uint32_t d = 1; d < array.count; ++d) below *= lengthOf(array, d);
    for (uint32_t d = 0; d < array.count; ++d) {
      const int64_t low = rung_dimension_at(&module_, array.first + d)->low;
      if (!append(size, d == 0 ? "[" : ",")) return false;
      if (!append(size, static_cast<int64_t>(static_cast<uint64_t>(low) + number / below))) return false;
      number %= below;
      if (d + 1 < array.count) below /= lengthOf(array, d + 1);
    }
    return append(size, "]");
  }
  uint64_t lengthOf(const rung_type& array, uint32_t dimension) const {
    const rung_dimension& is = *rung_dimension_at(&module_, array.first + dimension);
    return is.high < is.low ? 0 : static_cast<uint64_t>(is.high) - static_cast<uint64_t>(is.low) + 1;
  }

  bool visitElements(const rung_variable& variable, uint32_t size) {
    const rung_type& type = *variable.type;
    const rung_type* const element = rung_type_at(&module_, type.element);
    uint64_t count = 1;
    for (uint32_t d = 0; d < type.count; ++d) count *= lengthOf(type, d);
    for (uint64_t number = 0; number < count; ++number) {
      rung_variable part = variable;
      part.type = element;
      part.offsets[part.pointers] += static_cast<uint32_t>(number * element->size);
      uint32_t its_size = size;
      if (appendIndices(its_size, type, number) && !visit(part, its_size, nullptr, nullptr)) return false;
      path_[size] = 0;
    }
    return true;
  }

  const rung_module& module_;
  char* const path_;
  const uint32_t capacity_;
  const rung_visit visit_;
  void* const data_;
};

}  // namespace

extern "C" {

void rung_variable_of_symbol(const rung_module* module, uint32_t index, rung_variable* variable) {
  const rung_symbol& symbol = *rung_symbol_at(module, index);
  variable->type = rung_type_at(module, symbol.type);
  variable->flags = symbol.flags;
  variable->storage = symbol.storage;
  variable->bit = symbol.bit;
  variable->pointers = 0;
  variable->index = symbol.index;
  variable->offsets[0] = symbol.offset;
  if ((symbol.flags & RUNG_FIELD_BY_REFERENCE) != 0) addPointer(*variable);
}

uint32_t rung_path_of_symbol(const rung_module* module, uint32_t index, char* path, uint32_t capacity) {
  const rung_symbol& symbol = *rung_symbol_at(module, index);
  const char* const name = module->strings + symbol.name;
  uint32_t hash = rung_name_seed(RUNG_NONE);
  for (const char* c = name; *c != 0; ++c) hash = rung_name_hash(hash, *c);
  const size_t size = strlen(name);
  const bool is_shared =
      RUNG_NONE != findIn({namesOf(*module), 0, module->symbols.count, 0}, hash, [&](uint32_t i) {
        return i != index && rung_equal_names(name, size, module->strings + rung_symbol_at(module, i)->name);
      });
  const char* const prefix = is_shared ? module->strings + symbol.path : "";
  const size_t prefix_size = strlen(prefix);
  if (prefix_size + size >= capacity) return 0;
  memcpy(path, prefix, prefix_size);
  memcpy(path + prefix_size, name, size + 1);
  return static_cast<uint32_t>(prefix_size + size);
}

rung_path_error rung_find_step(const rung_module* module, rung_path* path, rung_variable* variable) {
  if (variable->type == nullptr) return findRoot(*module, *path, *variable);
  if (path->at == path->end) return RUNG_PATH_STEP;
  switch (*path->at) {
    case '.': return stepToMember(*module, *path, *variable);
    case '[': return stepToElement(*module, *path, *variable);
    case '^': return stepToTarget(*module, *path, *variable);
    default: return RUNG_PATH_STEP;
  }
}

bool rung_find(const rung_module* module, const char* text, rung_variable* variable) {
  rung_path path{text, text + strlen(text), 0};
  variable->type = nullptr;
  do {
    if (rung_find_step(module, &path, variable) != RUNG_PATH_OK) return false;
  } while (path.at != path.end);
  return true;
}

bool rung_walk_variable(const rung_module* module, const rung_variable* variable, char* path, uint32_t capacity,
                        rung_visit visit, void* data) {
  return Walk(*module, path, capacity, visit, data)
      .visit(*variable, static_cast<uint32_t>(strlen(path)), nullptr, nullptr);
}

}  // extern "C"
