// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/cursor.h"

#include <algorithm>

#include "frontend/syntax/node_at.h"

namespace rung::ide {
namespace {

// Where the innermost POU around a location begins; else the file.
Loc beginOfPou(const View& view, const FileUnit& unit, Loc at) {
  Loc begin = view.sources().begin(unit.file);
  for (const NodeRef node : nodeAt(view.tree(), unit, at))
    if (node.category == NodeRef::Category::Decl && view.tree().kind(DeclId{node.word}) == DeclKind::Pou)
      begin = view.tree().decl(DeclId{node.word}).begin;
  return begin;
}

// Where the last token before an offset begins: a POU whose last line is not finished may end there.
size_t lastTokenBefore(std::string_view source, size_t offset) {
  while (offset > 0 && isBlankCharacter(source[offset - 1])) --offset;
  return offset == 0 ? 0 : offset - 1;
}

CursorPlace placeIn(const Unit& unit, std::string_view text, size_t offset) {
  const bool is_inside = offset < unit.end;
  switch (unit.kind) {
    case UnitKind::Comment: return is_inside || text.starts_with("//") ? CursorPlace::Comment : CursorPlace::Code;
    case UnitKind::Pragma: return is_inside || !text.ends_with('}') ? CursorPlace::Pragma : CursorPlace::Code;
    case UnitKind::String:
      return is_inside || text.size() < 2 || text.back() != text.front() ? CursorPlace::String : CursorPlace::Code;
    case UnitKind::Number: return CursorPlace::Number;
    case UnitKind::Name:
    case UnitKind::Other:
    case UnitKind::End: break;
  }
  return CursorPlace::Code;
}

void readUnits(Cursor& cursor, size_t begin) {
  Scanner scanner(cursor.source);
  scanner.moveTo(begin);
  cursor.place = CursorPlace::Code;
  cursor.unit_begin = cursor.offset;
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End && unit.begin < cursor.offset; unit = scanner.next()) {
    if (unit.end >= cursor.offset) {
      cursor.place = placeIn(unit, scanner.textOf(unit), cursor.offset);
      if (cursor.place != CursorPlace::Code || unit.kind == UnitKind::Name) {
        cursor.unit_begin = unit.begin;
        cursor.prefix = cursor.source.substr(unit.begin, cursor.offset - unit.begin);
        return;
      }
    }
    if (unit.kind != UnitKind::Comment && unit.kind != UnitKind::Pragma) cursor.units.push_back(unit);
  }
}

// The unit that opens what the unit closes, `(` for `)`; 0 where it is missing.
size_t openingOf(const Cursor& cursor, size_t unit) {
  int depth = 0;
  for (size_t at = unit + 1; at-- > 0;) {
    const std::string_view text = cursor.text(at);
    if (text == ")" || text == "]") ++depth;
    if ((text == "(" || text == "[") && --depth == 0) return at;
  }
  return 0;
}

bool isName(const Cursor& cursor, size_t unit) { return cursor.units[unit].kind == UnitKind::Name; }

}  // namespace

size_t beginOfPath(const Cursor& cursor, size_t end) {
  size_t at = end;
  while (at > 0) {
    const std::string_view text = cursor.text(at - 1);
    if (text == "]" || text == ")") {
      at = openingOf(cursor, at - 1);
    } else if (text == "^") {
      --at;
    } else if (isName(cursor, at - 1)) {
      --at;
      if (at < 2 || (cursor.text(at - 1) != "." && cursor.text(at - 1) != "#")) return at;
      --at;  // goes on before the dot
    } else {
      return end;
    }
  }
  return end;
}

namespace {

class PathReader {
 public:
  PathReader(const View& view, const Cursor& cursor)
      : view_(view), cursor_(cursor), scope_(view.meanings().scope()), types_(scope_.project().types) {}

  Value read(size_t begin, size_t end) {
    Value value = first(begin);
    for (size_t at = begin + 1; at < end; ++at) {
      const std::string_view text = cursor_.text(at);
      if ((text == "." || text == "#") && at + 1 < end) {
        value = member(value, cursor_.text(++at));
      } else if (text == "^" || text == "[") {
        // A pointer that was reached by THIS is the object already.
        if (!is_this_ || text == "[") value = {{}, types_.info(types_.resolve(value.type)).base};
        if (text == "[") at = closingOf(at, end);
      } else if (text == "(") {
        value = {{}, resultOf(value)};
        at = closingOf(at, end);
      }
      is_this_ = false;
    }
    return value;
  }

 private:
  Value valueOf(Entity entity) const { return {entity, scope_.typeOf(entity)}; }
  NameId keyOf(std::string_view name) const { return view_.names().key(view_.names().find(name)); }

  Value first(size_t at) {
    const std::string_view name = cursor_.text(at);
    const bool is_this = sameIdentifier(name, "THIS"), is_super = sameIdentifier(name, "SUPER");
    if (!is_this && !is_super) return valueOf(scope_.lookUp(cursor_.pou, keyOf(name)));
    is_this_ = true;
    return {{}, view_.meanings().typeOfObject(cursor_.pou, is_super)};
  }

  Value member(const Value& value, std::string_view name) const {
    const Entity found =
        value.entity ? scope_.memberOf(value.entity, keyOf(name)) : scope_.memberOf(value.type, keyOf(name));
    return valueOf(found);
  }

  TypeId resultOf(const Value& callee) const {
    const PouId pou = calledBy(scope_, callee);
    return pou ? scope_.project().pou(pou).result : TypeId{};
  }

  // Of `(` or `[` at a unit.
  size_t closingOf(size_t at, size_t end) const {
    int depth = 0;
    for (; at < end; ++at) {
      const std::string_view text = cursor_.text(at);
      if (text == "(" || text == "[") ++depth;
      if ((text == ")" || text == "]") && --depth == 0) return at;
    }
    return end;
  }

  const View& view_;
  const Cursor& cursor_;
  const Scope& scope_;
  const types::TypeTable& types_;
  bool is_this_ = false;
};

// The `(` that is open at the end of the units, within the statement.
std::optional<size_t> openParenthesis(const Cursor& cursor) {
  int depth = 0;
  for (size_t at = cursor.units.size(); at-- > 0;) {
    const std::string_view text = cursor.text(at);
    if (text == ";") return std::nullopt;
    if (text == ")") ++depth;
    if (text == "(" && depth-- == 0) return at;
  }
  return std::nullopt;
}

}  // namespace

Cursor cursorAt(const View& view, FileId file, uint32_t byte) {
  Cursor cursor;
  const Loc parsed = view.parsedAt(file, byte);
  const FileUnit* const unit = parsed ? view.unitWith(parsed) : nullptr;
  if (unit == nullptr || view.snapshot().project() == nullptr) return cursor;
  const Loc base = cursor.base = view.sources().begin(unit->file);
  cursor.source = view.sources().original(unit->file);
  cursor.offset = parsed.offset - base.offset;
  Loc at = parsed;
  cursor.pou = view.meanings().pouAt(at);
  if (!cursor.pou) {
    at = {base.offset + static_cast<uint32_t>(lastTokenBefore(cursor.source, cursor.offset))};
    cursor.pou = view.meanings().pouAt(at);
  }
  readUnits(cursor, beginOfPou(view, *unit, at).offset - base.offset);
  return cursor;
}

Value valueBefore(const View& view, const Cursor& cursor, size_t unit) {
  const size_t begin = beginOfPath(cursor, unit);
  return begin == unit ? Value{} : PathReader(view, cursor).read(begin, unit);
}

PouId calledBy(const Scope& scope, const Value& callee) {
  const sema::Project& project = scope.project();
  if (callee.entity.entityKind() == EntityKind::Pou) return {callee.entity.index};
  if (callee.entity.entityKind() == EntityKind::Program) return project.instances[callee.entity.index].program;
  return scope.blockOf(scope.recordOf(callee.type));
}

std::optional<OpenCall> openCallAt(const View& view, const Cursor& cursor) {
  const std::optional<size_t> open = openParenthesis(cursor);
  if (!open || *open == 0) return std::nullopt;
  OpenCall call;
  if (isName(cursor, *open - 1)) call.name = cursor.text(*open - 1);
  call.callee = valueBefore(view, cursor, *open);
  int depth = 0;
  size_t begin = *open + 1;  // of the argument
  for (size_t at = *open + 1; at < cursor.units.size(); ++at) {
    const std::string_view text = cursor.text(at);
    if (text == "(" || text == "[") ++depth;
    if (text == ")" || text == "]") --depth;
    const bool follows_name = at > begin && isName(cursor, at - 1);
    const bool names_pin = follows_name && depth == 0 && at + 1 < cursor.units.size() &&
                           ((text == ":" && cursor.text(at + 1) == "=") || (text == "=" && cursor.text(at + 1) == ">"));
    if (names_pin) call.pin = cursor.text(at - 1);
    if (text != "," || depth != 0) continue;
    if (!call.pin.empty()) call.given.push_back(call.pin);
    call.pin = {};
    ++call.argument;
    begin = at + 1;
  }
  call.is_at_beginning = begin == cursor.units.size();
  if (!call.is_at_beginning && isName(cursor, begin)) call.first = cursor.text(begin);
  return call;
}

}  // namespace rung::ide
