// SPDX-License-Identifier: Apache-2.0
// What an editor folds, and what it selects step by step. In: a view. Out: ranges of a file.
#pragma once

#include <vector>

#include "tools/ide/view.h"

namespace rung::ide {

enum class FoldKind : uint8_t { Code, Comment, Region };
struct Fold {
  FileRange range;  // from its first line to its last one
  FoldKind kind;
  bool keeps_last_line = false;  // the last line closes it: END_IF
};
// Declarations, statements and their branches, comments, and regions between `{region}` and `{endregion}`, where they
// have several lines.
std::vector<Fold> foldsOf(const View& view, FileId file);

// The ranges around a byte, from the token to the file; each contains the one before it.
std::vector<FileRange> selectionAt(const View& view, FileId file, uint32_t byte);

}  // namespace rung::ide
