// SPDX-License-Identifier: Apache-2.0
// What precedes the cursor. In: a byte of a file. Out: the tokens of the declaration around it up to there, and what
// the path before it denotes. Works on the text, not on the tree, because the line at the cursor is seldom finished.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "frontend/source/scanner.h"
#include "tools/ide/meanings.h"
#include "tools/ide/view.h"

namespace rung::ide {

enum class CursorPlace : uint8_t {
  Outside,
  Comment,
  String,
  Pragma,
  Number,
  Code
};  // Outside: nothing was parsed there

struct Cursor {
  CursorPlace place = CursorPlace::Outside;
  Loc base;                 // where the text that was parsed begins
  PouId pou;                // around it; none: file level
  std::string_view source;  // of the parsed text
  size_t offset = 0;        // in it
  std::vector<Unit> units;  // before the name that is being typed; without comments and pragmas
  size_t unit_begin = 0;    // of the name, string or pragma at the cursor
  std::string_view prefix;  // what of it is before the cursor

  std::string_view text(size_t unit) const {
    return source.substr(units[unit].begin, units[unit].end - units[unit].begin);
  }
  // The unit before the last `back` ones; empty: there is none.
  std::string_view before(size_t back = 0) const {
    return units.size() > back ? text(units.size() - 1 - back) : std::string_view();
  }
};
Cursor cursorAt(const View& view, FileId file, uint32_t byte);

// The first unit of the path that ends before `end`; `end`: there is no path.
size_t beginOfPath(const Cursor& cursor, size_t end);

// Of the path that ends before a unit: `a.b[i]^`.
Value valueBefore(const View& view, const Cursor& cursor, size_t unit);

// The call whose arguments the cursor is in.
struct OpenCall {
  Value callee;
  std::string_view name;                // the last name of the callee
  uint32_t argument = 0;                // counted from 0
  std::string_view pin;                 // `pin := ` before the cursor; empty: positional, or not typed yet
  std::string_view first;               // the name that the argument begins with, when it is complete
  bool is_at_beginning = false;         // only a part of a name has been typed of the argument
  std::vector<std::string_view> given;  // the pins of the arguments before
};
std::optional<OpenCall> openCallAt(const View& view, const Cursor& cursor);

// The POU that a call of this value runs; none: it cannot be called, or is a library block that is not used yet.
PouId calledBy(const Scope& scope, const Value& callee);

}  // namespace rung::ide
