// SPDX-License-Identifier: Apache-2.0
// Paths of variables: see rung/monitor.h.
#include "rung/monitor.h"
#include "text.h"

namespace {

constexpr uint8_t kNoBit = 255;
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

// The decimal number at the front; false: there is none, or it is above all that a path may have.
bool takeNumber(rung_path& path, uint32_t& number) {
  constexpr uint32_t kMost = 400'000'000;
  const char* const begin = path.at;
  for (number = 0; path.at != path.end && isDigit(*path.at); ++path.at) {
    if (number > kMost) return false;
    number = number * 10 + static_cast<uint32_t>(*path.at - '0');
  }
  return path.at != begin;
}

size_t sizeOf(const rung_path& path) { return static_cast<size_t>(path.end - path.at); }

// ---- names

const rung_names* namesOf(const rung_module& module) {
  const rung_extension* const extension = rung_find_extension(&module.extensions, RUNG_NAMES);
  return extension == nullptr ? nullptr : static_cast<const rung_names*>(extension->data);
}

// The search for a name among the symbols of a module, or among the fields of one record. The name is the first column
// of both tables.
struct Search {
  const rung_module* module;
  const rung_table* table;
  const rung_names* names;  // null: the module has none
  uint32_t first, count;    // of the rows of the table
  uint32_t base;            // what is added to them in rung_names
  uint32_t hash;
  const char* name;
  size_t size;
  uint32_t at = 0, left = 0;  // the next row of the table, or of rung_names; how many remain

  void add(char c) { hash = rung_name_hash(hash, c); }
  void begin() {
    at = names == nullptr ? 0 : rung_name_slot(hash, names->slots.count);
    left = names == nullptr ? count : names->slots.count;
  }
  // The next row with the name; RUNG_NONE: none.
  uint32_t next() {
    for (; left != 0; --left, ++at) {
      uint32_t index = at;  // from `first`
      if (names != nullptr) {
        const uint32_t number = slot();
        if (number == 0) break;
        index = number - 1 - base - first;
      }
      if (index >= count) continue;
      const void* const row = rung_row(table, first + index);
      if (!rung_equal_names(name, size, module->strings + *static_cast<const uint32_t*>(row))) continue;
      --left, ++at;
      return first + index;
    }
    return RUNG_NONE;
  }

 private:
  uint32_t slot() {
    const rung_table& slots = names->slots;
    if (at == slots.count) at = 0;
    const void* const row = rung_row(&slots, at);
    return slots.row_size == 2 ? *static_cast<const uint16_t*>(row) : *static_cast<const uint32_t*>(row);
  }
};

Search amongSymbols(const rung_module& module, const char* name) {
  return {&module, &module.symbols, namesOf(module), 0, module.symbols.count, 0, rung_name_seed(RUNG_NONE), name, 0};
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
uint32_t findSymbolAt(Search& search, const rung_path& path, const char* begin, const char*& end) {
  search.hash = rung_name_seed(RUNG_NONE);
  search.name = begin;
  uint32_t found = RUNG_NONE;
  for (const char* at = begin; at != path.end;) {
    for (; at != path.end && isNameCharacter(*at); ++at) search.add(*at);
    search.size = static_cast<size_t>(at - begin);
    search.begin();
    uint32_t symbol;
    do {
      symbol = search.next();
    } while (symbol != RUNG_NONE && !fitsPrefix(*search.module, *rung_symbol_at(search.module, symbol), path.at,
                                                static_cast<size_t>(begin - path.at)));
    if (symbol != RUNG_NONE) {
      found = symbol;
      end = at;
    }
    if (at == path.end || *at != '.') break;
    search.add(*at++);
  }
  return found;
}

// The symbol with the longest path at the front.
bool findSymbol(const rung_module& module, rung_path& path, rung_variable& variable) {
  Search search = amongSymbols(module, path.at);
  const char* end = path.at;
  uint32_t found = RUNG_NONE;
  const char* begin = path.at;
  for (uint32_t prefixes = 0; prefixes <= kMostPrefixes; ++prefixes) {
    const char* its_end = path.at;
    const uint32_t symbol = findSymbolAt(search, path, begin, its_end);
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

// The area whose prefix is at the front; RUNG_NONE: none.
uint32_t takeArea(const rung_module& module, rung_path& rest) {
  for (uint32_t i = 0; i < module.areas.count; ++i) {
    const char* const prefix = module.strings + rung_area_at(&module, i)->prefix;
    const size_t size = strlen(prefix);
    if (size == 0 || size > sizeOf(rest) || !rung_equal_names(rest.at, size, prefix)) continue;
    rest.at += size;
    return i;
  }
  return RUNG_NONE;
}

// What an address names: the number of a unit of 1 << shift bytes, and of a BOOL a bit.
struct Address {
  uint32_t number = 0, shift = 0, bit = kNoBit;
};

// `X0.3`, `B4`, `W6`, and `5` or `X5` (byte 0, bit 5).
rung_path_error readAddress(rung_path& rest, Address& address) {
  const char width = rest.at != rest.end ? rung_lower(*rest.at) : char{0};
  if (width >= 'a') ++rest.at;
  if (width >= 'a' && width != 'x') {
    static const char kWidths[] = "bwdl";
    const char* const found = strchr(kWidths, width);
    if (found == nullptr) return RUNG_PATH_WIDTH;
    address.shift = static_cast<uint32_t>(found - kWidths);
    return takeNumber(rest, address.number) && rest.at == rest.end ? RUNG_PATH_OK : RUNG_PATH_ADDRESS;
  }
  if (!takeNumber(rest, address.number)) return RUNG_PATH_ADDRESS;
  address.bit = address.number % 8;
  if (rest.at == rest.end) return address.number /= 8, RUNG_PATH_OK;
  const bool is_complete = *rest.at++ == '.' && takeNumber(rest, address.bit) && address.bit < 8 && rest.at == rest.end;
  return is_complete ? RUNG_PATH_OK : RUNG_PATH_ADDRESS;
}

// `9056` and `9056.17`: words and bits of the NCT ladder's memory.
rung_path_error readNctAddress(rung_path& rest, Address& address) {
  const char* const begin = rest.at;
  if (!takeNumber(rest, address.number) || rest.at - begin != 4) return RUNG_PATH_UNKNOWN;
  address.shift = 2;
  if (rest.at == rest.end) return RUNG_PATH_OK;
  uint32_t bit = 0;
  if (*rest.at++ != '.' || !takeNumber(rest, bit) || rest.at - begin != 7 || rest.at != rest.end || bit > 31)
    return RUNG_PATH_UNKNOWN;
  address = {address.number * 4 + bit / 8, 0, bit % 8};
  return RUNG_PATH_OK;
}

// A part of an area, declared or not.
rung_path_error findAddress(const rung_module& module, rung_path& path, rung_variable& variable) {
  if (path.at == path.end || (*path.at != '%' && !isDigit(*path.at))) return RUNG_PATH_UNKNOWN;
  const bool is_nct = *path.at != '%';
  rung_path rest = path;
  Address address;
  rung_path_error error = RUNG_PATH_OK;
  if (is_nct) {
    error = readNctAddress(rest, address);
    rest.at = "%N";
    rest.end = rest.at + 2;
  }
  const uint32_t area = takeArea(module, rest);
  if (error == RUNG_PATH_OK && area == RUNG_NONE) error = RUNG_PATH_ADDRESS;
  if (error == RUNG_PATH_OK && !is_nct) error = readAddress(rest, address);
  if (error != RUNG_PATH_OK) return error;
  path.detail = area;
  if (address.number >= rung_area_at(&module, area)->size >> address.shift) return RUNG_PATH_OUTSIDE;
  variable.type = address.bit == kNoBit ? &kBitStrings[address.shift] : &kBool;
  variable.flags = 0;
  variable.storage = RUNG_IN_AREA;
  variable.bit = static_cast<uint8_t>(address.bit);
  variable.pointers = 0;
  variable.index = area;
  variable.offsets[0] = address.number << address.shift;
  path.at = path.end;
  path.detail = RUNG_NONE;
  return RUNG_PATH_OK;
}

rung_path_error findRoot(const rung_module& module, rung_path& path, rung_variable& variable) {
  return findSymbol(module, path, variable) ? RUNG_PATH_OK : findAddress(module, path, variable);
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

// Bounds are DINT; a dimension may be empty.
uint32_t lengthOf(const rung_dimension& dimension) {
  return dimension.high < dimension.low ? 0 : static_cast<uint32_t>(dimension.high - dimension.low) + 1;
}

// A number with its sign, and the blanks around it.
bool takeSigned(rung_path& rest, int64_t& number) {
  takeBlanks(rest);
  const bool is_negative = rest.at != rest.end && *rest.at == '-';
  if (is_negative) ++rest.at;
  uint32_t magnitude = 0;
  if (!takeNumber(rest, magnitude)) return false;
  takeBlanks(rest);
  number = is_negative ? -int64_t{magnitude} : int64_t{magnitude};
  return true;
}

rung_path_error stepToElement(const rung_module& module, rung_path& path, rung_variable& variable) {
  const rung_type& type = *variable.type;
  if (type.kind != RUNG_ARRAY) return RUNG_PATH_NO_ARRAY;
  rung_path rest = path;
  rest.end = static_cast<const char*>(memchr(path.at, ']', sizeOf(path)));
  if (rest.end == nullptr) return RUNG_PATH_BRACKET;
  uint32_t element = 0, d = 0;
  do {
    path.detail = d;
    ++rest.at;  // after `[` or `,`
    int64_t index = 0;
    const bool is_number = takeSigned(rest, index), is_last = rest.at == rest.end;
    if (!is_number && d == 0 && is_last) return RUNG_PATH_DIMENSIONS;
    if (!is_number || (!is_last && *rest.at != ',')) return RUNG_PATH_INDEX;
    if (is_last != (d + 1 == type.count)) return RUNG_PATH_DIMENSIONS;
    const rung_dimension& dimension = *rung_dimension_at(&module, type.first + d);
    if (index < dimension.low || index > dimension.high) return RUNG_PATH_RANGE;
    element = element * lengthOf(dimension) + static_cast<uint32_t>(index - dimension.low);
  } while (++d < type.count);
  variable.type = rung_type_at(&module, type.element);
  variable.offsets[variable.pointers] += element * variable.type->size;
  path.at = rest.end + 1;
  path.detail = RUNG_NONE;
  return RUNG_PATH_OK;
}

// `3` or `%X3` of an integer or bit string.
rung_path_error stepToBit(rung_path& path, const rung_path& name, rung_variable& variable) {
  rung_path digits = name;
  if (sizeOf(name) > 2 && name.at[0] == '%' && rung_lower(name.at[1]) == 'x') digits.at += 2;
  uint32_t bit = 0;
  if (!takeNumber(digits, bit) || digits.at != name.end || bit / 8 >= variable.type->size) return RUNG_PATH_NO_BIT;
  variable.type = &kBool;
  variable.offsets[variable.pointers] += bit / 8;  // little-endian
  variable.bit = static_cast<uint8_t>(bit % 8);
  path.at = name.end;
  path.detail = RUNG_NONE;
  return RUNG_PATH_OK;
}

// The field of this name that the record declares itself.
uint32_t findField(const rung_module& module, const rung_type& record, const rung_path& name) {
  Search search{&module,
                &module.fields,
                namesOf(module),
                record.first,
                record.count,
                module.symbols.count,
                rung_name_seed(record.first),
                name.at,
                sizeOf(name)};
  for (const char* c = name.at; c != name.end; ++c) search.add(*c);
  search.begin();
  uint32_t field;
  do {
    field = search.next();
  } while (field != RUNG_NONE && (rung_field_at(&module, field)->flags & RUNG_FIELD_BASE) != 0);
  return field;
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
  uint32_t index, offset = 0;  // of the base in the record
  for (const rung_type* record = variable.type; (index = findField(module, *record, name)) == RUNG_NONE;) {
    const rung_field* const base = baseOf(module, *record);
    if (base == nullptr) return RUNG_PATH_NO_FIELD;
    record = rung_type_at(&module, base->type);
    offset += base->offset;
  }
  const rung_field& field = *rung_field_at(&module, index);
  const bool is_reference = (field.flags & RUNG_FIELD_BY_REFERENCE) != 0;
  if (is_reference && variable.pointers == RUNG_VARIABLE_POINTERS) return RUNG_PATH_DEPTH;
  enterField(module, field, variable);
  variable.offsets[variable.pointers] += offset;
  setFlags(variable, field.flags);
  if (is_reference) addPointer(variable);
  path.at = name.end;
  path.detail = index;
  return RUNG_PATH_OK;
}

rung_path_error stepToMember(const rung_module& module, rung_path& path, rung_variable& variable) {
  rung_path name{path.at + 1, path.at + 1, 0};
  while (name.end != path.end && isNameCharacter(*name.end)) ++name.end;
  const bool has_bits = variable.type->kind >= RUNG_BYTE && variable.type->kind <= RUNG_ULINT && variable.bit == kNoBit;
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
    return variable.type->kind != RUNG_ARRAY || visitElements(variable, size, 0, 0);
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
  bool append(uint32_t& size, int32_t number) {
    char digits[12];
    char* at = digits + sizeof digits - 1;
    *at = 0;
    auto rest = number < 0 ? 0 - static_cast<uint32_t>(number) : static_cast<uint32_t>(number);
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

  // The elements with all indices of the dimensions from `d` on; `number`: of the indices before.
  bool visitElements(const rung_variable& variable, uint32_t size, uint32_t d, uint32_t number) {
    const rung_type& type = *variable.type;
    const rung_dimension& dimension = *rung_dimension_at(&module_, type.first + d);
    const uint32_t length = lengthOf(dimension);
    number *= length;
    for (uint32_t i = 0; i < length; ++i, ++number) {
      uint32_t its_size = size;
      if (!append(its_size, d == 0 ? "[" : ",") || !append(its_size, static_cast<int32_t>(dimension.low + i)))
        return true;
      if (d + 1 < type.count) {
        if (!visitElements(variable, its_size, d + 1, number)) return false;
        continue;
      }
      rung_variable part = variable;
      part.type = rung_type_at(&module_, type.element);
      part.offsets[part.pointers] += number * part.type->size;
      if (append(its_size, "]") && !visit(part, its_size, nullptr, nullptr)) return false;
    }
    path_[size] = 0;
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
  Search search = amongSymbols(*module, name);
  for (; name[search.size] != 0; ++search.size) search.add(name[search.size]);
  search.begin();
  uint32_t other = search.next();
  if (other == index) other = search.next();
  const size_t size = search.size;
  const bool is_shared = other != RUNG_NONE;
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
