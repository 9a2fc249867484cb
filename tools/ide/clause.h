// SPDX-License-Identifier: Apache-2.0
// The statement around the cursor, cut out so that it can be checked alone. In: the tokens before the cursor and the
// text after it. Out: its text on one line before and after what is written at the cursor: of a statement with blocks
// its head, `IF a AND | THEN END_IF;`. What is not finished yet is finished: open parentheses, `;`.
#pragma once

#include <string>

#include "tools/ide/completion_context.h"
#include "tools/ide/cursor.h"

namespace rung::ide {

struct Clause {
  std::string before, after;
  bool ends_here = false;  // nothing of it follows
  bool is_begin = false;   // before the cursor there is only what an assignment or a call begins with: `pump.`
};
// The cursor is in a body.
Clause clauseAround(const View& view, const Cursor& cursor, const CompletionContext& context);

}  // namespace rung::ide
