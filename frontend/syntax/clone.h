// Copies of expressions as the parser leaves them: what a diagram or a list reads in several places, so that sema may
// annotate each place by itself.
#pragma once

#include "frontend/syntax/tree.h"

namespace rung {

ExprId clone(Tree& tree, ExprId expr);

// A variable, a member or element of one at a place that names and literals give, a literal: reading it again costs
// nothing and calls nothing.
bool isPlainPath(const Tree& tree, ExprId expr);
// Whether something in it is called.
bool hasCall(const Tree& tree, ExprId expr);

}  // namespace rung
