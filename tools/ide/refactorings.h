// SPDX-License-Identifier: Apache-2.0
// Changes of a program that keep what it does, at a selection: an expression becomes a variable, statements a method,
// an IF chain a CASE and back; and what completes it: the values that a CASE lacks. In: a view and bytes of a file.
// Out: code actions; none where the selection is not one that can be changed. Bodies in ST.
#pragma once

#include <vector>

#include "tools/ide/code_actions.h"

namespace rung::ide {

std::vector<CodeAction> refactoringsAt(const View& view, const FileRange& selection);

}  // namespace rung::ide
