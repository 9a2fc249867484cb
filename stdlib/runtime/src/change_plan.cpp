// SPDX-License-Identifier: Apache-2.0
// What becomes of each variable when another version of the program takes the place of the running one: see
// rung/change.h. A block whose layout is the same stays where it is. All others get new memory, and the values of
// variables with the same path and type: whole runs of bytes where a structure is the same, else member by member.
#include "places.h"
#include "rung/monitor.h"
#include "text.h"

using namespace rung_change_detail;

namespace {

constexpr const char* kClass = "__type";
constexpr uint32_t kLayoutFlags = RUNG_FIELD_BY_REFERENCE | RUNG_FIELD_BASE | RUNG_FIELD_BIT | RUNG_FIELD_CONSTANT;
constexpr uint32_t kNotCopied = RUNG_FIELD_CONSTANT | RUNG_FIELD_NO_COPY;

class Planner {
 public:
  explicit Planner(rung_change& plan)
      : plan_(plan), old_(*plan.old_module), now_(*plan.module), path_(plan.path, plan.path_capacity) {}

  bool run() {
    plan_.move_count = plan_.holder_count = plan_.kept_count = plan_.refused_count = 0;
    if (tablesOf(old_) == nullptr || tablesOf(now_) == nullptr) {
      note(RUNG_IS_REFUSED, RUNG_REASON_TABLES, "", "");
      return false;
    }
    for (uint32_t i = 0; i < old_.types.count; ++i) plan_.same[i] = kUnknown;
    for (uint32_t i = 0; i < now_.blocks.count; ++i) planBlock(i);
    for (uint32_t i = 0; i < old_.blocks.count; ++i)
      if (twinOf(old_, now_, i) == RUNG_NONE) removeBlock(i);
    for (uint32_t i = 0; i < now_.symbols.count; ++i) planLocated(i);
    plan_.keeps_types = poolOf(old_) == RUNG_NONE || keepsTypes();
    return plan_.refused_count == 0 && plan_.move_count <= plan_.move_capacity &&
           plan_.holder_count <= plan_.holder_capacity;
  }

 private:
  static constexpr uint32_t kUnknown = RUNG_NONE, kDiffers = RUNG_NONE - 1;

  // ---- names and types

  const rung_type& oldType(uint32_t index) const { return *rung_type_at(&old_, index); }
  const rung_type& nowType(uint32_t index) const { return *rung_type_at(&now_, index); }
  const char* oldText(uint32_t offset) const { return old_.strings + offset; }
  const char* nowText(uint32_t offset) const { return now_.strings + offset; }
  static bool equal(const char* a, const char* b) { return rung_equal_names(a, strlen(a), b); }

  uint32_t classOf(const rung_module& module, uint32_t type) const {
    const rung_table& classes = tablesOf(module)->classes;
    for (uint32_t i = 0; i < classes.count; ++i)
      if (*static_cast<const uint32_t*>(rung_row(&classes, i)) == type) return i + 1;
    return 0;
  }

  // The same-named block of another version, the nth where there are several.
  static uint32_t twinOf(const rung_module& module, const rung_module& other, uint32_t block) {
    const char* const name = module.strings + rung_block_at(&module, block)->name;
    uint32_t before = 0;
    for (uint32_t i = 0; i < block; ++i)
      if (equal(module.strings + rung_block_at(&module, i)->name, name)) ++before;
    for (uint32_t i = 0; i < other.blocks.count; ++i)
      if (equal(other.strings + rung_block_at(&other, i)->name, name) && before-- == 0) return i;
    return RUNG_NONE;
  }

  // Whether two types lie in memory in the same way, down to the last bit.
  bool isSame(uint32_t old_index, uint32_t now_index) {
    uint32_t& known = plan_.same[old_index];
    if (known == now_index) return true;
    if (known == kDiffers && oldType(old_index).kind == RUNG_RECORD) return false;
    const bool is_same = compare(oldType(old_index), nowType(now_index));
    known = is_same ? now_index : oldType(old_index).kind == RUNG_RECORD ? kDiffers : kUnknown;
    return is_same;
  }

  bool compare(const rung_type& a, const rung_type& b) {
    if (a.kind != b.kind || a.size != b.size || a.length != b.length || a.is_signed != b.is_signed) return false;
    if (a.kind == RUNG_ENUM || a.kind == RUNG_POINTER) return equal(oldText(a.name), nowText(b.name));
    if (a.kind == RUNG_ARRAY) return haveSameBounds(a, b) && isSame(a.element, b.element);
    return a.kind != RUNG_RECORD || haveSameFields(a, b);
  }

  bool haveSameBounds(const rung_type& a, const rung_type& b) const {
    if (a.count != b.count) return false;
    for (uint32_t d = 0; d < a.count; ++d) {
      const rung_dimension& one = *rung_dimension_at(&old_, a.first + d);
      const rung_dimension& other = *rung_dimension_at(&now_, b.first + d);
      if (one.low != other.low || one.high != other.high) return false;
    }
    return true;
  }

  bool haveSameFields(const rung_type& a, const rung_type& b) {
    if (a.count != b.count || !equal(oldText(a.name), nowText(b.name))) return false;
    for (uint32_t i = 0; i < a.count; ++i) {
      const rung_field &one = fieldOf(old_, a, i), &other = fieldOf(now_, b, i);
      if (one.offset != other.offset || ((one.flags ^ other.flags) & kLayoutFlags) != 0) return false;
      if (!equal(oldText(one.name), nowText(other.name)) || !isSame(one.type, other.type)) return false;
    }
    return true;
  }

  // Whether a variable of another type may take the value: both have the same kind of value.
  bool takesValue(const rung_type& old_type, const rung_type& now_type) const {
    if (old_type.kind != now_type.kind || old_type.size != now_type.size) return false;
    return (old_type.kind != RUNG_ENUM && old_type.kind != RUNG_POINTER) ||
           equal(oldText(old_type.name), nowText(now_type.name));
  }

  // Whether the bytes of a type are copied as they are: no member says otherwise.
  bool isCopiedWhole(const rung_type& type) const {
    if (type.kind == RUNG_ARRAY) return isCopiedWhole(nowType(type.element));
    if (type.kind != RUNG_RECORD) return true;
    for (uint32_t i = 0; i < type.count; ++i) {
      const rung_field& field = fieldOf(now_, type, i);
      if ((field.flags & kNotCopied) != 0) return false;
      if ((field.flags & RUNG_FIELD_BY_REFERENCE) == 0 && !isCopiedWhole(nowType(field.type))) return false;
    }
    return true;
  }

  bool keepsTypes() {
    const rung_table &before = tablesOf(old_)->classes, &now = tablesOf(now_)->classes;
    if (before.count != now.count) return false;
    for (uint32_t i = 0; i < before.count; ++i)
      if (!isSame(*static_cast<const uint32_t*>(rung_row(&before, i)),
                  *static_cast<const uint32_t*>(rung_row(&now, i))))
        return false;
    for (uint32_t i = 0; i < old_.types.count; ++i)
      if (oldType(i).kind == RUNG_RECORD && oldType(i).library == 0 && !keepsType(i)) return false;
    return true;
  }
  bool keepsType(uint32_t old_index) {
    for (uint32_t i = 0; i < now_.types.count; ++i)
      if (nowType(i).kind == RUNG_RECORD && equal(nowText(nowType(i).name), oldText(oldType(old_index).name)))
        return isSame(old_index, i);
    return false;
  }

  // ---- rows of the plan

  void move(const rung_move& row) {
    if (plan_.move_count < plan_.move_capacity) plan_.moves[plan_.move_count] = row;
    ++plan_.move_count;
  }
  void moveBytes(uint32_t old_index, Place from, Place to, uint64_t size) {
    move({from.memory, from.offset, to.memory, to.offset, static_cast<uint32_t>(size), old_index, kNoBit, kNoBit});
  }
  void hold(const rung_holder& row) {
    if (plan_.holder_count < plan_.holder_capacity) plan_.holders[plan_.holder_count] = row;
    ++plan_.holder_count;
  }

  void note(rung_change_kind kind, rung_change_reason reason, const char* old_text, const char* new_text) {
    if (kind == RUNG_IS_REFUSED) ++plan_.refused_count;
    if (plan_.note == nullptr) return;
    const rung_change_note told{kind, reason, shortest(kind), old_text, new_text};
    plan_.note(plan_.data, &told);
  }

  // The path without the name of its list of globals, where it is clear without it.
  const char* shortest(rung_change_kind kind) const {
    const rung_module& module = kind == RUNG_IS_REMOVED ? old_ : now_;
    const char* const rest = path_.text() + list_size_;
    rung_variable with, without;
    if (list_size_ == 0 || !rung_find(&module, path_.text(), &with) || !rung_find(&module, rest, &without))
      return path_.text();
    return rung_is_same_variable(&with, &without) ? rest : path_.text();
  }

  // ---- blocks

  // The path begins with the name of a program, or of a list of globals, whose name is left out later.
  void beginPath(const rung_module& module, uint32_t block) {
    const char* const name = module.strings + rung_block_at(&module, block)->name;
    path_.cut(0);
    path_.add(name);
    rung_variable variable;
    const bool is_program =
        rung_find(&module, name, &variable) && variable.storage == RUNG_IN_BLOCK && variable.index == block;
    list_size_ = is_program ? 0 : path_.size() + 1;
  }

  void planBlock(uint32_t block) {
    plan_.kept[block] = RUNG_NONE;
    const uint32_t twin = twinOf(now_, old_, block);
    const rung_block_life *life = lifeOfBlock(now_, block), *old_life = nullptr;
    if (life == nullptr) return;
    if (twin != RUNG_NONE) old_life = lifeOfBlock(old_, twin);
    beginPath(now_, block);
    if (old_life == nullptr) return noteNew(life->type);
    const rung_type &is = nowType(life->type), &was = oldType(old_life->type);
    if (!equal(oldText(was.name), nowText(is.name))) return noteNew(life->type);
    const bool stays =
        isSame(old_life->type, life->type) && rung_block_at(&now_, block)->align <= rung_block_at(&old_, twin)->align;
    if (stays) {
      plan_.kept[block] = twin;
      if (!isHidden(nowText(rung_block_at(&now_, block)->name))) plan_.kept_count += count(is);
      holdIn(old_life->type, life->type, {twin, 0}, {block, 0});
      return;
    }
    match(old_life->type, life->type, {twin, 0}, {block, 0});
  }

  // A program is new as a whole, a list of globals variable by variable.
  void noteNew(uint32_t record) {
    if (list_size_ == 0) return note(RUNG_IS_INITIALISED, RUNG_REASON_NEW, "", "");
    noteFields(now_, nowType(record), RUNG_IS_INITIALISED, RUNG_REASON_NEW);
  }
  void removeBlock(uint32_t block) {
    const rung_block_life* const life = lifeOfBlock(old_, block);
    if (life == nullptr) return;
    beginPath(old_, block);
    if (list_size_ == 0) return note(RUNG_IS_REMOVED, RUNG_REASON_MISSING, "", "");
    noteFields(old_, oldType(life->type), RUNG_IS_REMOVED, RUNG_REASON_MISSING);
  }
  void noteFields(const rung_module& module, const rung_type& record, rung_change_kind kind,
                  rung_change_reason reason) {
    const uint32_t size = path_.size();
    for (uint32_t i = 0; i < record.count; ++i) {
      const rung_field& field = fieldOf(module, record, i);
      if ((field.flags & RUNG_FIELD_CONSTANT) != 0 || isHidden(module.strings + field.name)) continue;
      path_.addField(module.strings + field.name);
      note(kind, reason, "", "");
      path_.cut(size);
    }
  }
  static bool isHidden(const char* name) { return *name == 0 || (name[0] == '_' && name[1] == '_'); }

  // How many elementary variables are in a type.
  uint32_t count(const rung_type& type) const {
    if (type.kind == RUNG_ARRAY) return static_cast<uint32_t>(elementsOf(now_, type)) * count(nowType(type.element));
    if (type.kind != RUNG_RECORD) return type.kind == RUNG_POINTER ? 0 : 1;
    uint32_t all = 0;
    for (uint32_t i = 0; i < type.count; ++i) {
      const rung_field& field = fieldOf(now_, type, i);
      const bool is_listed = (field.flags & (RUNG_FIELD_BY_REFERENCE | RUNG_FIELD_CONSTANT)) == 0 &&
                             ((field.flags & RUNG_FIELD_BASE) != 0 || !isHidden(nowText(field.name)));
      if (is_listed) all += count(nowType(field.type));
    }
    return all;
  }

  // ---- values that move

  void match(uint32_t old_index, uint32_t now_index, Place from, Place to) {
    const rung_type &was = oldType(old_index), &is = nowType(now_index);
    if (isSame(old_index, now_index) && isCopiedWhole(is)) {
      moveBytes(old_index, from, to, is.size);
      plan_.kept_count += count(is);
      return holdIn(old_index, now_index, from, to);
    }
    const bool both_records = was.kind == RUNG_RECORD && is.kind == RUNG_RECORD;
    if (both_records && equal(oldText(was.name), nowText(is.name))) return matchRecords(old_index, is, from, to);
    if (was.kind == RUNG_ARRAY && is.kind == RUNG_ARRAY && was.count == is.count) return matchArrays(was, is, from, to);
    if (was.kind < RUNG_ARRAY && takesValue(was, is)) {
      moveBytes(old_index, from, to, is.size);
      ++plan_.kept_count;
      return holdIn(old_index, now_index, from, to);
    }
    note(RUNG_IS_INITIALISED, RUNG_REASON_TYPE, oldText(was.name), nowText(is.name));
  }

  void matchRecords(uint32_t old_index, const rung_type& is, Place from, Place to) {
    const rung_type& was = oldType(old_index);
    move({from.memory, from.offset, to.memory, to.offset, 0, old_index, kNoBit, kNoBit});
    matchFields(was, is, from, to);
    noteMissing(was, is);
  }

  // The members of a record, which the old version may have in another base.
  void matchFields(const rung_type& was, const rung_type& is, Place from, Place to) {
    for (uint32_t i = 0; i < is.count; ++i) {
      const rung_field& field = fieldOf(now_, is, i);
      const Place here = to.at(field.offset);
      if ((field.flags & RUNG_FIELD_BASE) != 0) {
        matchBase(was, field, from, here);
        continue;
      }
      const char* const name = nowText(field.name);
      if (*name == 0 || equal(name, kClass) || (field.flags & kNotCopied) != 0) continue;
      const uint32_t size = path_.size();
      path_.addField(name);
      Place there = from;
      const rung_field* const before = findField(old_, was, name, there);
      if (before == nullptr) {
        if (!isHidden(name)) note(RUNG_IS_INITIALISED, RUNG_REASON_NEW, "", "");
      } else {
        matchField(*before, field, there, here);
      }
      path_.cut(size);
    }
  }

  void matchBase(const rung_type& was, const rung_field& field, Place from, Place to) {
    const rung_type& base = nowType(field.type);
    Place there = from;
    const uint32_t before = findBase(was, nowText(base.name), there);
    if (before == RUNG_NONE) return matchFields(was, base, from, to);
    if (isSame(before, field.type) && isCopiedWhole(base)) return match(before, field.type, there, to);
    move({there.memory, there.offset, to.memory, to.offset, 0, before, kNoBit, kNoBit});
    matchFields(was, base, from, to);
  }

  void matchField(const rung_field& before, const rung_field& field, Place from, Place to) {
    const uint32_t both = before.flags | field.flags;
    if ((both & RUNG_FIELD_BIT) != 0) {
      move({from.memory, from.offset, to.memory, to.offset, 1, RUNG_NONE, bitOf(before), bitOf(field)});
      ++plan_.kept_count;
    } else if ((both & RUNG_FIELD_BY_REFERENCE) == 0) {
      match(before.type, field.type, from, to);
    }  // an in-out is given again by the next call
  }

  // The field of this name in a record or its bases; `place` becomes its place.
  static const rung_field* findField(const rung_module& module, const rung_type& record, const char* name,
                                     Place& place) {
    for (uint32_t i = 0; i < record.count; ++i) {
      const rung_field& field = fieldOf(module, record, i);
      Place there = place.at(field.offset);
      if ((field.flags & RUNG_FIELD_BASE) == 0) {
        if (!equal(module.strings + field.name, name)) continue;
        place = there;
        return &field;
      }
      if (const rung_field* const found = findField(module, *rung_type_at(&module, field.type), name, there)) {
        place = there;
        return found;
      }
    }
    return nullptr;
  }

  // The type of the old base with this name.
  uint32_t findBase(const rung_type& record, const char* name, Place& place) const {
    for (uint32_t i = 0; i < record.count; ++i) {
      const rung_field& field = fieldOf(old_, record, i);
      if ((field.flags & RUNG_FIELD_BASE) == 0) continue;
      place = place.at(field.offset);
      const rung_type& base = oldType(field.type);
      return equal(oldText(base.name), name) ? field.type : findBase(base, name, place);
    }
    return RUNG_NONE;
  }

  void noteMissing(const rung_type& was, const rung_type& is) {
    for (uint32_t i = 0; i < was.count; ++i) {
      const rung_field& field = fieldOf(old_, was, i);
      if ((field.flags & RUNG_FIELD_BASE) != 0) {
        noteMissing(oldType(field.type), is);
        continue;
      }
      const char* const name = oldText(field.name);
      Place ignored{};
      if (isHidden(name) || (field.flags & RUNG_FIELD_CONSTANT) != 0 || findField(now_, is, name, ignored) != nullptr)
        continue;
      const uint32_t size = path_.size();
      path_.addField(name);
      note(RUNG_IS_REMOVED, RUNG_REASON_MISSING, "", "");
      path_.cut(size);
    }
  }

  // ---- arrays: elements keep their values by their indices

  // The elements of one row of the last dimension that both versions have, and how far it is walked.
  struct Rows {
    const rung_type &was, &is;
    Place from, to;
    bool is_same;
  };

  void matchArrays(const rung_type& was, const rung_type& is, Place from, Place to) {
    const bool is_same = isSame(was.element, is.element) && isCopiedWhole(nowType(is.element));
    matchDimension({was, is, from, to, is_same}, 0, 0, 0);
    bool has_new = false, has_removed = false;
    for (uint32_t d = 0; d < is.count; ++d) {
      const rung_dimension &before = *rung_dimension_at(&old_, was.first + d),
                           &now = *rung_dimension_at(&now_, is.first + d);
      has_new = has_new || now.low < before.low || now.high > before.high;
      has_removed = has_removed || now.low > before.low || now.high < before.high;
    }
    if (has_new) note(RUNG_IS_INITIALISED, RUNG_REASON_ELEMENTS, oldText(was.name), nowText(is.name));
    if (has_removed) note(RUNG_IS_REMOVED, RUNG_REASON_ELEMENTS, oldText(was.name), nowText(is.name));
  }

  // `before`, `now`: the elements that the outer indices have passed.
  void matchDimension(const Rows& rows, uint32_t d, uint64_t before, uint64_t now) {
    const rung_dimension& was = *rung_dimension_at(&old_, rows.was.first + d);
    const rung_dimension& is = *rung_dimension_at(&now_, rows.is.first + d);
    const int64_t low = was.low > is.low ? was.low : is.low, high = was.high < is.high ? was.high : is.high;
    if (low > high) return;
    before = before * lengthOf(was) + static_cast<uint64_t>(low - was.low);
    now = now * lengthOf(is) + static_cast<uint64_t>(low - is.low);
    const uint64_t length = static_cast<uint64_t>(high - low) + 1;
    if (d + 1 < rows.is.count) {
      for (uint64_t i = 0; i < length; ++i) matchDimension(rows, d + 1, before + i, now + i);
      return;
    }
    if (rows.is_same) return moveRun(rows, before, now, length);
    for (uint64_t i = 0; i < length; ++i) {
      const uint32_t size = path_.size();
      addElement(path_, now_, rows.is, now + i);
      match(rows.was.element, rows.is.element, rows.from.at((before + i) * oldType(rows.was.element).size),
            rows.to.at((now + i) * nowType(rows.is.element).size));
      path_.cut(size);
    }
  }

  void moveRun(const Rows& rows, uint64_t before, uint64_t now, uint64_t length) {
    const uint64_t size = nowType(rows.is.element).size;
    const Place from = rows.from.at(before * size), to = rows.to.at(now * size);
    moveBytes(rows.was.element, from, to, length * size);
    plan_.kept_count += static_cast<uint32_t>(length) * count(nowType(rows.is.element));
    holdInElements(rows.was.element, rows.is.element, from, to, length);
  }

  // ---- what depends on addresses

  // Whether memory of a type may hold addresses, or numbers of classes.
  bool holds(uint32_t old_index, uint32_t now_index) const {
    const rung_type& type = oldType(old_index);
    if (type.kind == RUNG_POINTER) return true;
    if (type.kind == RUNG_ARRAY) return holds(type.element, nowType(now_index).element);
    if (type.kind != RUNG_RECORD) return isInteger(type) && type.size == old_.pointer_size;
    if (classOf(old_, old_index) != classOf(now_, now_index)) return true;
    for (uint32_t i = 0; i < type.count; ++i) {
      const rung_field& field = fieldOf(old_, type, i);
      if ((field.flags & RUNG_FIELD_BY_REFERENCE) != 0 || holds(field.type, fieldOf(now_, nowType(now_index), i).type))
        return true;
    }
    return false;
  }

  // Rows for a place whose type is the same in both versions.
  void holdIn(uint32_t old_index, uint32_t now_index, Place from, Place to) {
    holdInElements(old_index, now_index, from, to, 1);
  }

  void holdInElements(uint32_t old_index, uint32_t now_index, Place from, Place to, uint64_t elements) {
    if (!holds(old_index, now_index)) return;
    const rung_type& type = oldType(old_index);
    const auto row = [&](uint8_t kind, Place at, Place here, uint32_t what) {
      hold({kind, at.memory, at.offset, here.memory, here.offset, static_cast<uint32_t>(elements), type.size, what});
    };
    if (type.kind == RUNG_POINTER) return row(RUNG_HOLDS_POINTER, from, to, type.element);
    if (isInteger(type)) return row(RUNG_HOLDS_NUMBER, from, to, RUNG_NONE);
    if (type.kind == RUNG_ARRAY) {
      const uint64_t inner = elementsOf(old_, type);
      return holdInElements(type.element, nowType(now_index).element, from, to, inner * elements);
    }
    for (uint64_t i = 0; i < elements; ++i)
      holdInFields(old_index, now_index, from.at(i * type.size), to.at(i * type.size));
  }

  // `is_base`: the record is the base of an object, whose class is that of the whole.
  void holdInFields(uint32_t old_index, uint32_t now_index, Place from, Place to, bool is_base = false) {
    const rung_type &was = oldType(old_index), &is = nowType(now_index);
    const uint32_t number = classOf(old_, old_index);
    if (!is_base && number != classOf(now_, now_index)) holdClass(now_index, from, to);
    for (uint32_t i = 0; i < was.count; ++i) {
      const rung_field &before = fieldOf(old_, was, i), &field = fieldOf(now_, is, i);
      const Place there = from.at(before.offset), here = to.at(field.offset);
      if ((before.flags & RUNG_FIELD_BASE) != 0 && (is_base || number != 0))
        holdInFields(before.type, field.type, there, here, true);
      else if ((before.flags & RUNG_FIELD_BY_REFERENCE) != 0)
        hold({RUNG_HOLDS_IN_OUT, there.memory, there.offset, here.memory, here.offset, 1, 0, before.type});
      else if ((before.flags & RUNG_FIELD_OPEN_ARRAY) != 0)
        hold({RUNG_HOLDS_IN_OUT, there.memory, there.offset, here.memory, here.offset, 1, 0,
              oldType(before.type).element});
      else
        holdIn(before.type, field.type, there, here);
    }
  }

  // The number of the class lies in the outermost base.
  void holdClass(uint32_t now_index, Place from, Place to) {
    Place there = from, here = to;
    const rung_type& type = nowType(now_index);
    if (findField(now_, type, kClass, here) == nullptr) return;
    there = from.at(here.offset - to.offset);
    hold({RUNG_HOLDS_CLASS, there.memory, there.offset, here.memory, here.offset, 1, 0, classOf(now_, now_index)});
  }

  // ---- located variables: the image keeps its bytes, but a variable may have got another address

  void planLocated(uint32_t index) {
    const rung_symbol& symbol = *rung_symbol_at(&now_, index);
    if (symbol.storage != RUNG_IN_AREA) return;
    list_size_ = 0;
    char* const path = plan_.path;
    if (rung_path_of_symbol(&now_, index, path, plan_.path_capacity) == 0) return;
    rung_variable before;
    const rung_type& type = nowType(symbol.type);
    const bool is_known = rung_find(&old_, path, &before) && before.storage == RUNG_IN_AREA && before.pointers == 0;
    const Place to{RUNG_RANGE_AREA | symbol.index, symbol.offset};
    if (!is_known || !takesValue(*before.type, type)) {
      move({RUNG_NONE, 0, to.memory, to.offset, type.size, RUNG_NONE, kNoBit, symbol.bit});
      return note(RUNG_IS_INITIALISED, is_known ? RUNG_REASON_TYPE : RUNG_REASON_NEW,
                  is_known ? oldText(before.type->name) : "", is_known ? nowText(type.name) : "");
    }
    ++plan_.kept_count;
    if (before.index == symbol.index && before.offsets[0] == symbol.offset && before.bit == symbol.bit) return;
    move({RUNG_RANGE_AREA | before.index, before.offsets[0], to.memory, to.offset, type.size, RUNG_NONE, before.bit,
          symbol.bit});
  }

  rung_change& plan_;
  const rung_module &old_, &now_;
  PathText path_;
  uint32_t list_size_ = 0;  // of the path: the name of a list of globals and its period
};

}  // namespace

bool rung_plan_change(rung_change* plan) { return Planner(*plan).run(); }
