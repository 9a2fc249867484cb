// SPDX-License-Identifier: Apache-2.0
// Brings a running program to another version by a plan: see rung/change.h. Old instances whose memory moves are told
// (FB_Exit), new memory gets its initial values (FB_Init), values are copied, what depends on addresses is set to the
// new ones, and the copied instances are told (FB_Reinit); CODESYS, "Methods FB_Init, FB_Reinit, FB_Exit".
#include "places.h"
#include "rung/monitor.h"
#include "text.h"

using namespace rung_change_detail;

namespace {

// The plan, and the memory of both versions. While it is applied the host's table of extensions has it.
struct Change {
  const rung_change& plan;
  const rung_context& old_context;
  const rung_context* context = nullptr;  // null while it is only checked
};

uint32_t sizeOf(const rung_module& module, uint32_t memory) {
  return isArea(memory) ? rung_area_at(&module, memory & ~RUNG_RANGE_AREA)->size : rung_block_at(&module, memory)->size;
}

// The memory that holds an address, and where in it; RUNG_NONE: none of this version.
Place placeOf(const rung_module& module, const rung_context& context, const uint8_t* address) {
  const auto holds = [&](uint32_t memory) {
    const uint8_t* const begin = addressOf(context, {memory, 0});
    return address >= begin && address < begin + sizeOf(module, memory);
  };
  const auto at = [&](uint32_t memory) {
    return Place{memory, static_cast<uint32_t>(address - addressOf(context, {memory, 0}))};
  };
  for (uint32_t i = 0; i < module.blocks.count; ++i)
    if (holds(i)) return at(i);
  for (uint32_t i = 0; i < module.areas.count; ++i)
    if (holds(RUNG_RANGE_AREA | i)) return at(RUNG_RANGE_AREA | i);
  return {RUNG_NONE, 0};
}

bool isKept(const rung_change& plan, uint32_t old_block) {
  for (uint32_t i = 0; i < plan.module->blocks.count; ++i)
    if (plan.kept[i] == old_block) return true;
  return false;
}

// ---- where an old place is in the new version

// Tells whether a record is of this type, or extends it.
bool isKindOf(const rung_module& module, uint32_t record, uint32_t type) {
  while (record != type) {
    const rung_type& is = *rung_type_at(&module, record);
    record = RUNG_NONE;
    for (uint32_t i = 0; i < is.count && record == RUNG_NONE; ++i)
      if ((fieldOf(module, is, i).flags & RUNG_FIELD_BASE) != 0) record = fieldOf(module, is, i).type;
    if (record == RUNG_NONE) return false;
  }
  return true;
}

// The record of the new version with the same name; RUNG_NONE: none.
uint32_t namesakeOf(const rung_change& plan, uint32_t record) {
  const char* const name = plan.old_module->strings + rung_type_at(plan.old_module, record)->name;
  for (uint32_t i = 0; i < plan.module->types.count; ++i) {
    const rung_type& type = *rung_type_at(plan.module, i);
    if (type.kind == RUNG_RECORD && rung_equal_names(name, strlen(name), plan.module->strings + type.name)) return i;
  }
  return RUNG_NONE;
}

// Tells whether an instance that moves is of this type, or extends it, in both versions.
bool staysKindOf(const rung_change& plan, uint32_t record, uint32_t type) {
  if (!isKindOf(*plan.old_module, record, type)) return false;
  const uint32_t now = namesakeOf(plan, record), wanted = namesakeOf(plan, type);
  return now != RUNG_NONE && wanted != RUNG_NONE && isKindOf(*plan.module, now, wanted);
}

// The new place of the instance at an old one, of several that begin there the one of this type, or that extends it.
Place movedInstance(const rung_change& plan, Place place, uint32_t type) {
  for (uint32_t i = 0; i < plan.move_count; ++i) {
    const rung_move& row = plan.moves[i];
    if (row.size == 0 && row.from == place.memory && row.from_offset == place.offset &&
        staysKindOf(plan, row.type, type))
      return {row.to, row.to_offset};
  }
  return {RUNG_NONE, 0};
}

// Tells whether instances or structures lie in values of this type.
bool holdsRecords(const rung_module& module, uint32_t type) {
  while (type != RUNG_NONE && rung_type_at(&module, type)->kind == RUNG_ARRAY)
    type = rung_type_at(&module, type)->element;
  return type != RUNG_NONE && rung_type_at(&module, type)->kind == RUNG_RECORD;
}

// The new place of a byte that is copied; for a record only where records are copied as they are.
Place movedValue(const rung_change& plan, Place place, bool is_record) {
  for (uint32_t i = 0; i < plan.move_count; ++i) {
    const rung_move& row = plan.moves[i];
    if (row.size != 0 && row.from == place.memory && row.from_bit == kNoBit && place.offset >= row.from_offset &&
        place.offset - row.from_offset < row.size && (!is_record || holdsRecords(*plan.old_module, row.type)))
      return {row.to, row.to_offset + (place.offset - row.from_offset)};
  }
  return {RUNG_NONE, 0};
}

// The type of the object at an old place, by the number of its class; RUNG_NONE: none.
uint32_t typeOfObject(const Change& change, Place place) {
  const rung_module& module = *change.plan.old_module;
  const rung_table& classes = tablesOf(module)->classes;
  uint32_t number = 0;
  if (sizeOf(module, place.memory) - place.offset < sizeof number) return RUNG_NONE;
  memcpy(&number, addressOf(change.old_context, place), sizeof number);
  if (number == 0 || number > classes.count) return RUNG_NONE;
  return *static_cast<const uint32_t*>(rung_row(&classes, number - 1));
}

// An interface has nothing but the number of an object's class.
bool isInterface(const rung_module& module, const rung_type& type) {
  return type.kind == RUNG_RECORD && type.count == 1 &&
         strcmp(module.strings + fieldOf(module, type, 0).name, "__type") == 0;
}

// The new place of what a pointer with this target points to; RUNG_NONE: it has none.
Place movedTarget(const Change& change, Place place, uint32_t target) {
  const rung_change& plan = change.plan;
  const rung_type& type = *rung_type_at(plan.old_module, target);
  const bool is_record = type.kind == RUNG_RECORD;
  const uint32_t instance = isInterface(*plan.old_module, type) ? typeOfObject(change, place) : target;
  const Place found = is_record && instance != RUNG_NONE ? movedInstance(plan, place, instance) : Place{RUNG_NONE, 0};
  return found.memory != RUNG_NONE ? found : movedValue(plan, place, is_record);
}

enum class Fate : uint8_t { Stays, Moves, Lost };

// What becomes of an address of the old version. `place`: where it is, and then where it will be.
Fate fateOf(const Change& change, uintptr_t value, uint32_t target, Place& place) {
  const rung_change& plan = change.plan;
  place = placeOf(*plan.old_module, change.old_context, reinterpret_cast<const uint8_t*>(value));
  if (place.memory == RUNG_NONE) return Fate::Stays;
  if (isArea(place.memory)) {
    const uint32_t area = place.memory & ~RUNG_RANGE_AREA;
    const bool exists = area < plan.module->areas.count && place.offset < rung_area_at(plan.module, area)->size;
    if (!exists) return Fate::Lost;
    return rung_area_at(plan.module, area)->size == rung_area_at(plan.old_module, area)->size ? Fate::Stays
                                                                                              : Fate::Moves;
  }
  if (isKept(plan, place.memory)) return Fate::Stays;
  if (target == RUNG_NONE) return Fate::Lost;
  const Place moved = movedTarget(change, place, target);
  if (moved.memory == RUNG_NONE) return Fate::Lost;
  place = moved;
  return Fate::Moves;
}

uintptr_t addressAt(const uint8_t* at) {
  uintptr_t value = 0;
  memcpy(&value, at, sizeof value);
  return value;
}

// ---- the check

class Checker {
 public:
  Checker(rung_change& plan, const rung_context& old_context) : plan_(plan), change_{plan, old_context} {}

  bool run() {
    for (uint32_t i = 0; i < plan_.holder_count; ++i) {
      const rung_holder& row = plan_.holders[i];
      if (row.kind == RUNG_HOLDS_CLASS || row.kind == RUNG_HOLDS_IN_OUT) continue;
      for (uint32_t k = 0; k < row.count; ++k) check(row, {row.from, row.from_offset + k * row.stride});
    }
    if (!plan_.keeps_types && hasDynamicObjects()) refuse({RUNG_NONE, 0}, {RUNG_NONE, 0}, RUNG_REASON_DYNAMIC);
    return plan_.refused_count == 0;
  }

 private:
  void check(const rung_holder& row, Place holder) {
    Place place{};
    const uintptr_t value = addressAt(addressOf(change_.old_context, holder));
    const bool is_pointer = row.kind == RUNG_HOLDS_POINTER;
    if (value == 0 || fateOf(change_, value, is_pointer ? row.what : RUNG_NONE, place) != Fate::Lost) return;
    refuse(holder, place, is_pointer ? RUNG_REASON_POINTER : RUNG_REASON_ADDRESS);
  }

  void refuse(Place holder, Place target, rung_change_reason reason) {
    ++plan_.refused_count;
    if (plan_.note == nullptr) return;
    PathText path(plan_.path, plan_.path_capacity), of_target(plan_.target, plan_.path_capacity);
    if (holder.memory != RUNG_NONE) describePlace(path, *plan_.old_module, holder);
    if (target.memory != RUNG_NONE) describePlace(of_target, *plan_.old_module, target);
    const rung_change_note note{RUNG_IS_REFUSED, reason, path.text(), of_target.text(), ""};
    plan_.note(plan_.data, &note);
  }

  // The pool of __NEW is a list of globals of the runtime. Each of its units of 8 bytes belongs to a run, whose first
  // unit has twice its length, plus 1 where an object is in it.
  bool hasDynamicObjects() const {
    const rung_module& module = *plan_.old_module;
    const uint32_t block = poolOf(module);
    if (block == RUNG_NONE) return false;
    const uint8_t* const units = addressOf(change_.old_context, {block, 0});
    const uint32_t count = rung_block_at(&module, block)->size / 8;
    for (uint32_t at = 0; at < count;) {
      uint64_t header = 0;
      memcpy(&header, units + size_t{at} * 8, sizeof header);
      if ((header & 1) != 0) return true;
      if (header == 0 || header / 2 > count - at) return false;
      at += static_cast<uint32_t>(header / 2);
    }
    return false;
  }

  rung_change& plan_;
  Change change_;
};

// ---- the change

class Applier {
 public:
  Applier(const rung_change& plan, rung_context& old_context, rung_context& context)
      : plan_(plan), old_(old_context), now_(context), change_{plan, old_context, &context} {}

  uint8_t run(rung_context*& faulted) {
    const rung_host no_host{};
    rung_host host = old_.host != nullptr ? *old_.host : no_host;
    const rung_extension extension{RUNG_CHANGE, &change_, sizeof change_};
    host.extensions = {&extension, 1, sizeof extension};
    const rung_host *const of_old = old_.host, *const of_now = now_.host;
    old_.host = now_.host = &host;
    saveImage();
    uint8_t fault = callAll(old_, &rung_block_life::exit, faulted);
    if (fault == RUNG_FAULT_NONE) fault = callAll(now_, &rung_block_life::init, faulted);
    if (fault == RUNG_FAULT_NONE) {
      for (uint32_t i = 0; i < plan_.move_count; ++i) copy(plan_.moves[i]);
      for (uint32_t i = 0; i < plan_.holder_count; ++i) relocate(plan_.holders[i]);
      fault = callAll(now_, &rung_block_life::refresh, faulted);
      restoreImage();
    }
    if (fault == RUNG_FAULT_NONE) fault = callAll(now_, &rung_block_life::reinit, faulted);
    old_.host = of_old;
    now_.host = of_now;
    return fault;
  }

 private:
  using Function = void (*rung_block_life::*)(rung_context*);

  // Calls a function of every block: `exit` in the reverse order, `refresh` of those that stay, all others of those
  // that do not.
  uint8_t callAll(rung_context& context, Function function, rung_context*& faulted) {
    const bool is_exit = function == &rung_block_life::exit;
    const rung_change_tables& tables = *tablesOf(*context.module);
    for (uint32_t i = 0; i < tables.blocks.count; ++i) {
      const rung_block_life& life = lifeOf(tables, is_exit ? tables.blocks.count - 1 - i : i);
      const bool stays = is_exit ? isKept(plan_, life.block) : plan_.kept[life.block] != RUNG_NONE;
      if (life.*function == nullptr || stays != (function == &rung_block_life::refresh)) continue;
      context.entry = &life;
      faulted = &context;
      if (const uint8_t fault = rung_guarded(&context, life.*function); fault != RUNG_FAULT_NONE) return fault;
    }
    faulted = nullptr;
    return RUNG_FAULT_NONE;
  }

  void copy(const rung_move& row) {
    if (row.size == 0 || isArea(row.to)) return;
    copyPart(row, addressOf(old_, {row.from, row.from_offset}), row.from_bit, addressOf(now_, {row.to, row.to_offset}));
  }
  // `from_bit`: of what is copied; the row says which bit it becomes.
  static void copyPart(const rung_move& row, const uint8_t* from, uint8_t from_bit, uint8_t* to) {
    if (from_bit == kNoBit && row.to_bit == kNoBit) {
      memcpy(to, from, row.size);
      return;
    }
    const bool value = (from_bit == kNoBit ? *from : *from >> from_bit & 1) != 0;
    const uint8_t mask = row.to_bit == kNoBit ? uint8_t{255} : static_cast<uint8_t>(1u << row.to_bit);
    const uint8_t set = row.to_bit == kNoBit ? uint8_t{value} : value ? mask : uint8_t{0};
    *to = static_cast<uint8_t>((*to & ~mask) | set);
  }

  void relocate(const rung_holder& row) {
    for (uint32_t k = 0; k < row.count; ++k) {
      uint8_t* const at = addressOf(now_, {row.to, row.to_offset + k * row.stride});
      if (row.kind == RUNG_HOLDS_CLASS) memcpy(at, &row.what, sizeof row.what);
      if (row.kind != RUNG_HOLDS_POINTER && row.kind != RUNG_HOLDS_IN_OUT) continue;
      Place place{};
      const uintptr_t value = addressAt(at);
      const Fate fate = value == 0 ? Fate::Stays : fateOf(change_, value, row.what, place);
      if (fate == Fate::Stays) continue;
      const uint8_t* const moved = fate == Fate::Moves ? addressOf(now_, place) : nullptr;
      memcpy(at, &moved, sizeof moved);
    }
  }

  // The image stays as it is, except for variables that are new in it or have another address: FB_Init and initial
  // values of others leave no trace.
  void saveImage() {
    uint8_t* to = plan_.image;
    for (uint32_t i = 0; i < plan_.old_module->areas.count; ++i) {
      const uint32_t size = rung_area_at(plan_.old_module, i)->size;
      memcpy(to, old_.areas[i], size);
      to += size;
    }
  }
  uint8_t* saved(uint32_t memory, uint32_t offset) const {
    uint8_t* at = plan_.image;
    const uint32_t area = memory & ~RUNG_RANGE_AREA;
    if (area >= plan_.old_module->areas.count || offset >= rung_area_at(plan_.old_module, area)->size) return nullptr;
    for (uint32_t i = 0; i < area; ++i) at += rung_area_at(plan_.old_module, i)->size;
    return at + offset;
  }
  // First what moves inside of the image, then what is new in it, then all else.
  void restoreImage() {
    for (uint32_t i = 0; i < plan_.move_count; ++i) {
      const rung_move& row = plan_.moves[i];
      const uint8_t* const from = isArea(row.to) && row.from != RUNG_NONE ? saved(row.from, row.from_offset) : nullptr;
      if (from != nullptr) copyPart(row, from, row.from_bit, addressOf(now_, {row.to, row.to_offset}));
    }
    for (uint32_t i = 0; i < plan_.move_count; ++i) {
      const rung_move& row = plan_.moves[i];
      uint8_t* const to = isArea(row.to) ? saved(row.to, row.to_offset) : nullptr;
      if (to != nullptr) copyPart(row, addressOf(now_, {row.to, row.to_offset}), row.to_bit, to);
    }
    for (uint32_t i = 0; i < plan_.old_module->areas.count && i < plan_.module->areas.count; ++i) {
      const uint32_t before = rung_area_at(plan_.old_module, i)->size, now = rung_area_at(plan_.module, i)->size;
      if (before != 0 && now != 0) memcpy(now_.areas[i], saved(RUNG_RANGE_AREA | i, 0), before < now ? before : now);
    }
  }

  const rung_change& plan_;
  rung_context &old_, &now_;
  const Change change_;
};

// The change that the host of a context applies; null: none.
const Change* changeOf(const rung_context& context) {
  if (context.host == nullptr) return nullptr;
  const rung_extension* const extension = rung_find_extension(&context.host->extensions, RUNG_CHANGE);
  return extension == nullptr ? nullptr : static_cast<const Change*>(extension->data);
}

}  // namespace

bool rung_check_change(rung_change* plan, const rung_context* old_context) {
  return Checker(*plan, *old_context).run();
}

uint8_t rung_apply_change(const rung_change* plan, rung_context* old_context, rung_context* context,
                          rung_context** faulted_context) {
  return Applier(*plan, *old_context, *context).run(*faulted_context);
}

bool rung_in_copy_code(const rung_context* context, const void* instance) {
  const Change* const change = changeOf(*context);
  if (change == nullptr || change->context == nullptr) return false;
  const bool is_old = context->module == change->plan.old_module;
  const Place place = placeOf(*context->module, *context, static_cast<const uint8_t*>(instance));
  for (uint32_t i = 0; i < change->plan.move_count && place.memory != RUNG_NONE; ++i) {
    const rung_move& row = change->plan.moves[i];
    const uint32_t memory = is_old ? row.from : row.to, offset = is_old ? row.from_offset : row.to_offset;
    const uint32_t size = row.size == 0 ? 1 : row.size;
    if (row.from == RUNG_NONE || memory != place.memory || place.offset < offset) continue;
    if (place.offset - offset < size) return true;
  }
  return false;
}
