// SPDX-License-Identifier: Apache-2.0
// Which completions make a program. In: the items, and the statement around the cursor. Out: the items of which a trial
// says that the statement has no error with them that it has not with any name. Used by completion.cpp.
#pragma once

#include <vector>

#include "tools/ide/clause.h"
#include "tools/ide/completion.h"

namespace rung::ide {

// Makes each item that is tried Whole or Part, the best first, as many as one trial takes. Leaves them where there can
// be no trial.
void tryItems(const Cursor& cursor, const Clause& clause, std::vector<CompletionItem>& items, CompletionTrial& trial);
// The same for types: the declaration before the cursor is that of variables that are used already.
void tryTypes(const View& view, const Cursor& cursor, std::vector<CompletionItem>& items, CompletionTrial& trial);
// Takes out what needs more when no letter is typed, else puts it last; and the worst, when there are too many.
void sortOut(const Cursor& cursor, Completion& completion);

}  // namespace rung::ide
