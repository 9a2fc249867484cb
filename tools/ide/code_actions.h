// SPDX-License-Identifier: Apache-2.0
// What an editor offers to do at a place: the fixes of diagnostics, and all sure fixes of a file at once. In: a view,
// and bytes of a file. Out: edits with titles. Refactorings are in refactorings.h.
#pragma once

#include <string>
#include <vector>

#include "tools/ide/diagnostics.h"
#include "tools/ide/text_edits.h"
#include "tools/workspace/fix.h"

namespace rung::ide {

enum class ActionKind : uint8_t { QuickFix, Extract, Inline, Rewrite, FixAll };

struct CodeAction {
  std::string title;
  ActionKind kind;
  bool is_preferred = false;
  std::vector<TextEdit> edits;
  const FileDiagnostic* diagnostic = nullptr;  // that it fixes; none: it is a refactoring
};

// Those of the diagnostics that touch the range. `diagnostics`: of the view, and living as long as the result.
std::vector<CodeAction> quickFixes(const View& view, const std::vector<FileDiagnostic>& diagnostics,
                                   const FileRange& range);
// The difference of a file to what all sure fixes in it make of it; without edits: there are none.
CodeAction fixAll(const View& view, FileId file, const workspace::Fixed& fixed);

}  // namespace rung::ide
