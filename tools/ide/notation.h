// SPDX-License-Identifier: Apache-2.0
// What may be written at a place of a chart or of networks in their notations (docs/networks.md). In: the tokens before
// the cursor, and the body. Out: the kind of thing, and for values a statement in ST that is right when they are: a
// contact is `IF | THEN END_IF;`. Used by completion.cpp.
#pragma once

#include <string>
#include <vector>

#include "tools/ide/clause.h"
#include "tools/ide/cursor.h"

namespace rung::ide {

enum class NotationPlace : uint8_t {
  None,      // a number, a modifier
  Step,      // FROM, TO
  Action,    // in a step
  Value,     // of a contact or an input, a condition
  Target,    // of a coil or an output
  Callee,    // what a box calls
  Instance,  // of the block `callee`
  Pin,       // of `callee`
  Output,    // of `callee`, at the beginning of a wire
};

struct Notation {
  NotationPlace place = NotationPlace::None;
  Clause clause;                   // of a value or target; of a pin or output where what it is wired to is known
  PouId callee;                    // none: not known
  TypeId expected;                 // none: any
  std::vector<std::string> given;  // pins that the box has already
  bool is_output = false;          // the pin has the sign of one after the cursor
  std::string box;                 // whose output it is: the instance, empty: a function; of an instance what it calls
  std::string instance;            // of the box whose callee is asked for; empty: it has none
};

// Whether the body of the POU is a chart or networks, so that its text is not ST.
bool isInNotation(const View& view, const Cursor& cursor);
Notation notationAt(const View& view, const Cursor& cursor);

}  // namespace rung::ide
