// SPDX-License-Identifier: Apache-2.0
// Questions that several passes ask about a body. Only the returned vectors allocate.
#pragma once

#include <vector>

#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::ir {

// By local: whether it is a value that only statements of this body read and write: no address, bind or reference.
std::vector<bool> privateLocals(const Module& module, const Body& body);

// Turns a node into a constant in place; the nodes below it are no longer used.
inline void becomeConst(Expr& e, TypeId type, uint64_t bits) {
  e.set(ConstExpr{.bits = bits});
  e.checks = 0;
  e.type = type;
}

// f(ExprId place): each place that a statement itself (not its blocks) writes or may write.
template <class F>
void forEachWritten(const Module& module, const Body& body, const Stmt& stmt, F&& f) {
  forEachRoot(module, body, stmt, [&](ExprId root, Use use) {
    if (use != Use::Read) f(root);
  });
}

}  // namespace rung::ir
