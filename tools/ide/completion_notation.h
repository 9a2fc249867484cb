// SPDX-License-Identifier: Apache-2.0
// Completions in the text of charts and networks, but for expressions: steps, actions, blocks, instances and pins. In:
// what is written at the cursor (notation.h). Out: items.
#pragma once

#include "tools/ide/completion.h"
#include "tools/ide/completion_context.h"
#include "tools/ide/notation.h"

namespace rung::ide {

Completion completionInNotation(const View& view, const LibraryIndex& libraries, const Cursor& cursor,
                                const CompletionContext& context, const Notation& notation);

}  // namespace rung::ide
