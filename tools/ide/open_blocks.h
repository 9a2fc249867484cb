// SPDX-License-Identifier: Apache-2.0
// The blocks of statements around the cursor. In: the tokens before it and the text after it. Out: which are closed
// later, so that no second END_IF is offered; whether a branch may begin; the labels that a CASE has. Used by
// completion.cpp.
#pragma once

#include <string>
#include <vector>

#include "tools/ide/completion_context.h"
#include "tools/ide/cursor.h"

namespace rung::ide {

struct Following {
  size_t closed = 0;           // how many of the blocks around the cursor
  bool has_branch = false;     // ELSE, ELSIF or a label of the innermost one
  bool closes_pou = false;     // END_FUNCTION_BLOCK
  bool has_statement = false;  // before that
};
Following followingOf(const Cursor& cursor);

// Of the innermost block.
struct Branches {
  bool is_in_else = false;
  bool has_label = false;           // of a CASE, before the cursor
  std::vector<std::string> labels;  // of a CASE, before and after the cursor, in capitals
};
Branches branchesAt(const Cursor& cursor, const CompletionContext& context);

}  // namespace rung::ide
