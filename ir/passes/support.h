// Questions that several passes ask about a body. Only the returned vectors allocate.
#pragma once

#include <vector>

#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::ir {

// Whether the evaluation of a tree may fault.
bool mayFault(const Body& body, ExprId root);

// By local: whether it is a value that only statements of this body read and write: no address, bind or reference.
std::vector<bool> privateLocals(const Module& module, const Body& body);

// Turns a node into a constant in place; the nodes below it are no longer used.
inline void becomeConst(Expr& e, TypeId type, uint64_t bits) {
  e.kind = ExprKind::Const;
  e.checks = 0;
  e.type = type;
  e.a = static_cast<uint32_t>(bits);
  e.b = static_cast<uint32_t>(bits >> 32);
  e.c = 0;
}
inline bool isConst(const Expr& e) { return e.kind == ExprKind::Const; }
inline types::Value valueOf(const Expr& e) { return {e.type, e.kind == ExprKind::String ? e.a : e.bits()}; }

// f(ExprId place): each place that a statement itself (not its blocks) writes or may write.
template <class F>
void forEachWritten(const Module& module, const Body& body, const Stmt& stmt, F&& f) {
  forEachRoot(module, body, stmt, [&](const uint32_t& slot, Use use) {
    if (use != Use::Read) f(ExprId{slot});
  });
}

}  // namespace rung::ir
