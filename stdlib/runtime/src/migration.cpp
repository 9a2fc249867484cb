// SPDX-License-Identifier: Apache-2.0
// The values of one version of a program in another: see rung/monitor.h. Retained data has a directory of its
// variables, a line each: `path TAB kind TAB offset TAB size TAB type`, and of a bit ` TAB bit`.
#include "rung/monitor.h"
#include "rung/retain.h"

namespace {

// ---- what is kept

enum class Kept : uint8_t { Not, Retained, Persistent };

const rung_range& rangeOf(const rung_table& ranges, uint32_t index) {
  return *static_cast<const rung_range*>(rung_row(&ranges, index));
}

// The ranges of one table, asked about one variable after the other.
class Ranges {
 public:
  // `begin`: where the first range is in the values of a slot.
  Ranges(const rung_table& ranges, uint32_t begin) : ranges_(ranges), offset_(begin) {
    while (sorted_ < ranges.count && isNext(sorted_)) ++sorted_;
  }

  // The range that has the whole variable; RUNG_NONE: none.
  uint32_t find(const rung_variable& variable) const {
    if (variable.pointers > 0) return RUNG_NONE;
    uint32_t low = 0, high = variable.storage == RUNG_IN_BLOCK ? sorted_ : 0;
    while (low < high) {  // the last range that begins at or before the variable
      const uint32_t middle = (low + high) / 2;
      const rung_range& range = rangeOf(ranges_, middle);
      const bool is_after =
          range.block > variable.index || (range.block == variable.index && range.offset > variable.offsets[0]);
      (is_after ? high : low) = is_after ? middle : middle + 1;
    }
    if (low > 0 && holds(rangeOf(ranges_, low - 1), variable)) return low - 1;
    for (uint32_t i = sorted_; i < ranges_.count; ++i)
      if (holds(rangeOf(ranges_, i), variable)) return i;
    return RUNG_NONE;
  }
  // Where the value of a variable in this range is in a slot. Quick where the next one is near.
  uint32_t offsetOf(const rung_variable& variable, uint32_t index) {
    for (; at_ < index; ++at_) offset_ += rangeOf(ranges_, at_).size;
    for (; at_ > index; --at_) offset_ -= rangeOf(ranges_, at_ - 1).size;
    const rung_range& range = rangeOf(ranges_, index);
    return (range.block & RUNG_RANGE_BIT) != 0 ? offset_ : offset_ + variable.offsets[0] - range.offset;
  }
  uint32_t end() const {
    uint32_t offset = offset_;
    for (uint32_t i = at_; i < ranges_.count; ++i) offset += rangeOf(ranges_, i).size;
    return offset;
  }

 private:
  // The ranges of blocks come first, by block and offset.
  bool isNext(uint32_t index) const {
    const rung_range& range = rangeOf(ranges_, index);
    if ((range.block & RUNG_RANGE_AREA) != 0) return false;
    if (index == 0) return true;
    const rung_range& before = rangeOf(ranges_, index - 1);
    return range.block > before.block || (range.block == before.block && range.offset > before.offset);
  }

  static bool holds(const rung_range& range, const rung_variable& variable) {
    const uint32_t offset = variable.offsets[0];
    if (variable.storage == RUNG_IN_BLOCK)
      return range.block == variable.index && offset >= range.offset &&
             offset - range.offset + variable.type->size <= range.size;
    if (variable.bit != 255)
      return range.block == (variable.index | RUNG_RANGE_AREA | RUNG_RANGE_BIT) &&
             range.offset == offset * 8 + variable.bit;
    return range.block == (variable.index | RUNG_RANGE_AREA) && offset >= range.offset &&
           offset - range.offset + variable.type->size <= range.size;
  }

  const rung_table& ranges_;
  uint32_t sorted_ = 0;  // how many are in order
  uint32_t at_ = 0;      // the range whose place in a slot is `offset_`
  uint32_t offset_;
};

// What a module keeps.
class Keeping {
 public:
  explicit Keeping(const rung_module& module)
      : retained_(module.retain, 0), persistent_(module.persistent, retained_.end()) {}

  Kept of(const rung_variable& variable) const {
    if (retained_.find(variable) != RUNG_NONE) return Kept::Retained;
    return persistent_.find(variable) != RUNG_NONE ? Kept::Persistent : Kept::Not;
  }
  // Where the value of a variable is in a slot; RUNG_NONE: it is not kept.
  uint32_t offsetOf(const rung_variable& variable) {
    const uint32_t retained = retained_.find(variable);
    if (retained != RUNG_NONE) return retained_.offsetOf(variable, retained);
    const uint32_t persistent = persistent_.find(variable);
    return persistent != RUNG_NONE ? persistent_.offsetOf(variable, persistent) : RUNG_NONE;
  }

 private:
  Ranges retained_, persistent_;
};

// ---- one variable

// What is known of a variable of the old version.
struct Old {
  const char* path;
  uint32_t kind, size;
  const char* type;
  const void* value;
  uint8_t bit;  // of `value`, or 255
};

void lose(rung_migration& migration, const Old& old, rung_loss why, const char* new_type) {
  ++migration.lost_count;
  if (migration.lost != nullptr) migration.lost(migration.data, old.path, why, old.type, new_type);
}

// Sets `variable` to the value of the old one, where its type is the same.
void bring(const rung_module& module, const rung_context& context, const rung_variable& variable, const Old& old,
           rung_migration& migration) {
  const rung_type& type = *variable.type;
  if (type.kind != old.kind || type.size != old.size)
    return lose(migration, old, RUNG_LOSS_TYPE, module.strings + type.name);
  const auto* const byte = static_cast<const uint8_t*>(old.value);
  const uint8_t bit = old.bit == 255 ? *byte : *byte >> old.bit & 1;
  const void* const value = type.kind == RUNG_BOOL ? &bit : old.value;
  if (rung_write_value(&context, &variable, value, type.size) == RUNG_ACCESS_OK) ++migration.kept;
}

// ---- all variables of a module

bool isHidden(const rung_module& module, const rung_part& part) {
  if (part.field == nullptr || (part.field->flags & RUNG_FIELD_BASE) != 0) return false;
  const char* const name = module.strings + part.field->name;
  return (part.field->flags & (RUNG_FIELD_BY_REFERENCE | RUNG_FIELD_CONSTANT)) != 0 || *name == 0 ||
         (name[0] == '_' && name[1] == '_');
}

// Whether a part has values of its own: neither an array or record nor a pointer.
bool isValue(const rung_part& part) { return part.variable->type->kind < RUNG_ARRAY; }

// What a visitor of all variables says: it uses values, and enters what is not hidden.
template <class Use>
rung_walk visitValue(const rung_module& module, const rung_part& part, Use use) {
  if (isHidden(module, part)) return RUNG_WALK_SKIP;
  if (isValue(part)) use(part);
  return RUNG_WALK_ENTER;
}

// Visits the variables of a symbol, which is not a pointer to them.
void walkSymbol(const rung_module& module, uint32_t symbol, rung_migration& migration, rung_visit visit, void* data) {
  rung_variable variable;
  rung_variable_of_symbol(&module, symbol, &variable);
  if (variable.pointers > 0 || rung_path_of_symbol(&module, symbol, migration.path, migration.path_capacity) == 0)
    return;
  rung_walk_variable(&module, &variable, migration.path, migration.path_capacity, visit, data);
}

// ---- from memory to memory

struct Versions {
  const rung_module* old_module;
  const rung_context* old_context;
  const rung_module* module;
  const rung_context* context;
  rung_migration* migration;
};

rung_walk migratePart(void* data, const rung_part* part) {
  const auto& all = *static_cast<const Versions*>(data);
  return visitValue(*all.old_module, *part, [&](const rung_part& value) {
    const rung_variable& is = *value.variable;
    const Old old{value.path,
                  is.type->kind,
                  is.type->size,
                  all.old_module->strings + is.type->name,
                  rung_address(all.old_context, &is),
                  is.bit};
    rung_variable now;
    if (rung_find(all.module, value.path, &now))
      bring(*all.module, *all.context, now, old, *all.migration);
    else
      lose(*all.migration, old, RUNG_LOSS_MISSING, "");
  });
}

// ---- the directory of retained data

class Lines {
 public:
  Lines(char* to, uint32_t capacity) : to_(to), capacity_(capacity) {}
  void put(char c) {
    if (size_ < capacity_) to_[size_] = c;
    ++size_;
  }
  void put(const char* text) {
    while (*text != 0) put(*text++);
  }
  void field(uint32_t number) {
    char digits[10];
    uint32_t count = 0;
    for (; number != 0 || count == 0; number /= 10) digits[count++] = static_cast<char>('0' + number % 10);
    put('\t');
    while (count > 0) put(digits[--count]);
  }
  uint32_t size() const { return size_; }

 private:
  char* to_;
  uint32_t capacity_, size_ = 0;
};

struct Listing {
  const rung_module* module;
  Keeping keeping;
  Lines lines;
};

rung_walk listPart(void* data, const rung_part* part) {
  auto& all = *static_cast<Listing*>(data);
  return visitValue(*all.module, *part, [&](const rung_part& value) {
    const rung_variable& is = *value.variable;
    const uint32_t offset = all.keeping.offsetOf(is);
    if (offset == RUNG_NONE) return;
    all.lines.put(value.path);
    all.lines.field(is.type->kind);
    all.lines.field(offset);
    all.lines.field(is.type->size);
    all.lines.put('\t');
    all.lines.put(all.module->strings + is.type->name);
    // A bit of an area is kept as a byte of its own.
    if (is.bit != 255 && is.storage == RUNG_IN_BLOCK) all.lines.field(is.bit);
    all.lines.put('\n');
  });
}

// A part of a line up to a tab or its end, as a string.
const char* takeField(char*& at) {
  const char* const begin = at;
  while (*at != 0 && *at != '\t') ++at;
  if (*at != 0) *at++ = 0;
  return begin;
}

uint32_t takeNumber(char*& at) {
  uint32_t number = 0;
  for (const char* c = takeField(at); *c >= '0' && *c <= '9'; ++c)
    number = number * 10 + static_cast<uint32_t>(*c - '0');
  return number;
}

// One line of a directory, in the room for a path.
void restoreLine(rung_context& context, const Keeping& keeping, const rung_slot& header, const uint8_t* values,
                 rung_start start, rung_migration& migration) {
  char* at = migration.path;
  Old old{takeField(at), 0, 0, "", nullptr, 255};
  old.kind = takeNumber(at);
  const uint32_t offset = takeNumber(at);
  old.size = takeNumber(at);
  old.type = takeField(at);
  if (*at != 0) old.bit = static_cast<uint8_t>(takeNumber(at) & 7);
  if (start == RUNG_COLD && offset < header.retain_bytes) return;
  if (old.size == 0 || uint64_t{offset} + old.size > header.value_bytes) return;
  old.value = values + offset;
  rung_variable now;
  if (!rung_find(context.module, old.path, &now)) return lose(migration, old, RUNG_LOSS_MISSING, "");
  const Kept kept = keeping.of(now);
  if (kept == Kept::Not && now.type->kind < RUNG_ARRAY) return lose(migration, old, RUNG_LOSS_NOT_RETAINED, "");
  if (start == RUNG_COLD && kept == Kept::Retained) return;
  const uint32_t before = migration.kept;
  bring(*context.module, context, now, old, migration);
  if (migration.kept != before) context.now_ns = header.time_ns;  // its timers go on
}

}  // namespace

extern "C" {

void rung_migrate(const rung_module* old_module, const rung_context* old_context, const rung_module* module,
                  const rung_context* context, rung_migration* migration) {
  Versions versions{old_module, old_context, module, context, migration};
  for (uint32_t i = 0; i < old_module->symbols.count; ++i)
    walkSymbol(*old_module, i, *migration, migratePart, &versions);
}

uint32_t rung_retain_directory(const rung_module* module, char* directory, uint32_t capacity,
                               rung_migration* migration) {
  Listing listing{module, Keeping(*module), Lines(directory, capacity)};
  for (uint32_t i = 0; i < module->symbols.count; ++i) {
    // A part of an area is listed under the name of the variable that keeps it: others may see it, too.
    const rung_symbol& symbol = *rung_symbol_at(module, i);
    const bool is_kept = (symbol.flags & (RUNG_FIELD_RETAIN | RUNG_FIELD_PERSISTENT)) != 0;
    if (symbol.storage == RUNG_IN_BLOCK || is_kept) walkSymbol(*module, i, *migration, listPart, &listing);
  }
  return listing.lines.size();
}

void rung_retain_migrate(rung_context* context, const void* slot, rung_start start, rung_migration* migration) {
  if (start == RUNG_ORIGIN) return;
  rung_slot header;
  memcpy(&header, slot, sizeof header);
  const auto* const values = static_cast<const uint8_t*>(slot) + sizeof header;
  const char* at = reinterpret_cast<const char*>(values) + header.value_bytes;
  const char* const end = reinterpret_cast<const char*>(values) + header.length;
  const Keeping keeping(*context->module);
  while (at < end) {
    const auto* const line_end = static_cast<const char*>(memchr(at, '\n', static_cast<size_t>(end - at)));
    if (line_end == nullptr) return;
    const auto size = static_cast<size_t>(line_end - at);
    if (size < migration->path_capacity) {
      memcpy(migration->path, at, size);
      migration->path[size] = 0;
      restoreLine(*context, keeping, header, values, start, *migration);
    }
    at = line_end + 1;
  }
}

}  // extern "C"
