// SPDX-License-Identifier: Apache-2.0
// Copies of expressions, and what their form tells: for schedulers that use an expression several times.
#pragma once

#include "frontend/syntax/tree.h"

namespace rung {

ExprId clone(Tree& tree, ExprId expr);

// A literal, or a variable, member or element whose path consists of names and literals: reading it again costs nothing
// and calls nothing.
bool isPlainPath(const Tree& tree, ExprId expr);
// Tells whether it contains a call.
bool hasCall(const Tree& tree, ExprId expr);

}  // namespace rung
