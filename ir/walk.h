// Walks over the expressions and statements of a body, without allocation and without std::function.
// Called by lowering, passes, the verifier, printer and codegen. The order is that of evaluation, left to right.
#pragma once

#include "ir/ir.h"

namespace rung::ir {

// f(uint32_t& slot): each operand of one node, as the slot that holds its id, so that a pass can replace it.
// With a const body the slots are const.
template <class BodyT, class ExprT, class F>
void forEachSlot(BodyT& body, ExprT& expr, F&& f) {
  switch (expr.kind) {
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::String:
    case ExprKind::Data:
    case ExprKind::Zero:
    case ExprKind::Local:
    case ExprKind::Self:
    case ExprKind::Global:
    case ExprKind::Program:
    case ExprKind::Image: return;
    case ExprKind::Field:
    case ExprKind::Deref:
    case ExprKind::Bits:
    case ExprKind::Unary:
    case ExprKind::Convert:
    case ExprKind::Address: f(expr.a); return;
    case ExprKind::Binary:
      f(expr.a);
      f(expr.b);
      return;
    case ExprKind::Select:
      f(expr.a);
      f(expr.b);
      f(expr.c);
      return;
    case ExprKind::Index:
      f(expr.a);
      for (uint32_t i = 0; i < expr.c; ++i) f(body.operands[expr.b + i].index);
      return;
    case ExprKind::Call:
      for (uint32_t i = 0; i < expr.c; ++i) f(body.operands[expr.b + i].index);
      return;
  }
}

// f(ExprId): the node and all below it, operands first.
template <class F>
void forEachExpr(const Body& body, ExprId root, F&& f) {
  forEachSlot(body, body.expr(root), [&](const uint32_t& slot) { forEachExpr(body, ExprId{slot}, f); });
  f(root);
}

// How a statement uses an expression that is directly in it.
enum class Use : uint8_t {
  Read,       // its value
  Write,      // a place that is assigned (a For control also read)
  Reference,  // a place given to a by-reference parameter or as instance: read and written
};

// f(uint32_t& slot, Use): each expression directly in a statement; empty slots are skipped.
template <class BodyT, class StmtT, class F>
void forEachRoot(const Module& module, BodyT& body, StmtT& stmt, F&& f) {
  auto visit = [&](auto& slot, Use use) {
    if (slot != 0) f(slot, use);
  };
  switch (stmt.kind) {
    case StmtKind::None:
    case StmtKind::Break:
    case StmtKind::Continue:
    case StmtKind::Return:
    case StmtKind::Jump:
    case StmtKind::Label:
    case StmtKind::Loop: return;
    case StmtKind::Assign:
      visit(stmt.a, Use::Write);
      visit(stmt.b, Use::Read);
      return;
    case StmtKind::Bind:
      visit(stmt.a, Use::Write);
      visit(stmt.b, Use::Reference);
      return;
    case StmtKind::Call: {
      visit(stmt.b, Use::Reference);
      const Body& callee = module.body(BodyId{stmt.a});
      uint32_t i = 0;
      for (const Local& local : callee.locals) {
        if (!isParameter(local)) continue;
        if (i == stmt.d) break;
        visit(body.operands[stmt.c + i].index, local.kind == LocalKind::Input ? Use::Read : Use::Reference);
        ++i;
      }
      visit(stmt.e, Use::Write);
      return;
    }
    case StmtKind::If:
    case StmtKind::Switch:
    case StmtKind::Evaluate:
    case StmtKind::Fault: visit(stmt.a, Use::Read); return;
    case StmtKind::For:
      visit(stmt.a, Use::Write);
      visit(stmt.b, Use::Read);
      visit(stmt.c, Use::Read);
      visit(stmt.d, Use::Read);
      return;
    case StmtKind::Try: visit(stmt.d, Use::Write); return;
    case StmtKind::Assert:
      visit(stmt.a, Use::Read);
      visit(stmt.b, Use::Read);
      visit(stmt.c, Use::Read);
      return;
  }
}

// f(slot): the first statement of each block that a statement holds, in order; empty blocks too (0). A slot is
// uint32_t& or, for a case's block, the index of its StmtId: also a uint32_t&.
template <class BodyT, class StmtT, class F>
void forEachBlock(BodyT& body, StmtT& stmt, F&& f) {
  switch (stmt.kind) {
    case StmtKind::None:
    case StmtKind::Assign:
    case StmtKind::Bind:
    case StmtKind::Call:
    case StmtKind::Break:
    case StmtKind::Continue:
    case StmtKind::Return:
    case StmtKind::Jump:
    case StmtKind::Label:
    case StmtKind::Fault:
    case StmtKind::Assert:
    case StmtKind::Evaluate: return;
    case StmtKind::If:
      f(stmt.b);
      f(stmt.c);
      return;
    case StmtKind::Switch:
      for (uint32_t i = 0; i < stmt.c; ++i) f(body.cases[stmt.b + i].block.index);
      f(stmt.d);
      return;
    case StmtKind::Loop:
      f(stmt.a);
      f(stmt.b);
      return;
    case StmtKind::For: f(stmt.e); return;
    case StmtKind::Try:
      f(stmt.a);
      f(stmt.b);
      f(stmt.c);
      return;
  }
}

// f(StmtId): every statement from `first` on, and those in their blocks, each before its blocks.
template <class F>
void forEachStmt(const Body& body, StmtId first, F&& f) {
  for (StmtId id = first; id; id = body.stmt(id).next) {
    f(id);
    forEachBlock(body, body.stmt(id), [&](const uint32_t& block) { forEachStmt(body, StmtId{block}, f); });
  }
}

// The variable at the root of a place, and whether the place is that variable itself.
inline ExprId rootOf(const Body& body, ExprId place) {
  while (true) {
    const Expr& e = body.expr(place);
    if (e.kind != ExprKind::Field && e.kind != ExprKind::Index && e.kind != ExprKind::Bits) return place;
    place = ExprId{e.a};
  }
}

}  // namespace rung::ir
