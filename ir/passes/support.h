// What several passes ask of a body. Nothing here allocates but the vectors that are returned.
#pragma once

#include <vector>

#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::ir {

// Whether the evaluation of a tree may fault.
bool mayFault(const Body& body, ExprId root);

// Whether a local is a value that only statements of this body read and write: no address, no bind, no reference.
std::vector<bool> privateLocals(const Module& module, const Body& body);

// Turns a node into another one in place; what was below it is no longer used.
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

// f(ExprId place): what a statement itself (not the ones in its blocks) writes or may write.
template <class F>
void forEachWritten(const Module& module, const Body& body, const Stmt& stmt, F&& f) {
  forEachRoot(module, body, stmt, [&](const uint32_t& slot, Use use) {
    if (use != Use::Read) f(ExprId{slot});
  });
}

}  // namespace rung::ir
