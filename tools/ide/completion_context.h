// SPDX-License-Identifier: Apache-2.0
// What may be written at the cursor. In: the tokens before it. Out: the kind of thing, the type that is expected, and
// the blocks that are open. Used by completion.cpp.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tools/ide/cursor.h"

namespace rung::ide {

enum class Writes : uint8_t {
  Nothing,        // a new name, a number
  Member,         // after a dot
  Item,           // after `Color#`
  Address,        // after `%`
  Declaration,    // outside of POUs
  Configuration,  // the beginning of a declaration in a CONFIGURATION
  Program,        // the type of a program there
  Section,        // CONSTANT, RETAIN … after VAR
  Variable,       // the beginning of a declaration of a variable
  Location,       // AT after its name
  Type,           // after its colon
  Header,         // EXTENDS, IMPLEMENTS after the name of a POU
  Statement,      // its beginning
  Expression,
  Operator  // after an operand
};
// What an expression must be.
enum class Needs : uint8_t { Any, Selector, Lvalue };

struct CompletionContext {
  Writes writes = Writes::Nothing;
  Value base;                  // of a member or item
  std::string_view base_name;  // its last name
  TypeId expected;             // of an expression; of an operator that of its left operand; none: any
  Needs needs = Needs::Any;
  std::optional<OpenCall> call;  // whose argument begins here
  std::vector<size_t> blocks;    // the units IF, CASE, FOR … that are not closed
  size_t body = 0;               // the unit that the body begins with
  bool has_body = false;         // a statement has begun in this POU
  bool is_in_body = false;       // after the header of a POU and its sections
};
CompletionContext contextAt(const View& view, const Cursor& cursor);

}  // namespace rung::ide
