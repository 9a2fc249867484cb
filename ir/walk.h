// SPDX-License-Identifier: Apache-2.0
// Walks over the expressions and statements of a body, without allocation and without std::function.
// Called by lowering, passes, the verifier, printer and codegen. The order is that of evaluation, left to right.
#pragma once

#include "ir/ir.h"

namespace rung::ir {

// NOLINTBEGIN(bugprone-macro-parentheses): the fields of a row become statements.
// Each row of instructions.def becomes a case: its fields that play no part in the walk expand to nothing.
#define RUNG_OPERAND(name)
#define RUNG_OPERANDS(name)
#define RUNG_READ(name)
#define RUNG_WRITE(name)
#define RUNG_REFERENCE(name)
#define RUNG_ARGUMENTS(name)
#define RUNG_BLOCK(name)
#define RUNG_CASES(name)
#define RUNG_VALUE(type, name)

// f(ExprId& operand): each operand of one node, in the place that holds it, so that a pass can replace it. With a const
// body the ids are const. `f` adds no expressions.
template <class BodyT, class ExprT, class F>
void forEachOperand(BodyT& body, ExprT& expr, F&& f) {
#undef RUNG_OPERAND
#undef RUNG_OPERANDS
#define RUNG_OPERAND(name) f(node.name);
#define RUNG_OPERANDS(name) \
  for (auto& operand : body.list(node.name)) f(operand);
#define RUNG_EXPR(kind, word, role, checks, fields)               \
  case ExprKind::kind: {                                          \
    [[maybe_unused]] auto& node = expr.template as<kind##Expr>(); \
    fields return;                                                \
  }
  switch (expr.kind) {
#include "ir/instructions.def"
  }
#undef RUNG_OPERAND
#undef RUNG_OPERANDS
#define RUNG_OPERAND(name)
#define RUNG_OPERANDS(name)
}

// f(ExprId): the node and all below it, operands first.
template <class F>
void forEachExpr(const Body& body, ExprId root, F&& f) {
  forEachOperand(body, body.expr(root), [&](ExprId operand) { forEachExpr(body, operand, f); });
  f(root);
}

// How a statement uses an expression that is directly in it.
enum class Use : uint8_t {
  Read,       // its value
  Write,      // a place that is assigned (a For control also read)
  Reference,  // a place given to a by-reference parameter or as instance: read and written
};

// f(ExprId& root, Use): each expression directly in a statement; a missing one is skipped.
template <class BodyT, class StmtT, class F>
void forEachRoot(const Module& module, BodyT& body, StmtT& stmt, F&& f) {
  auto visit = [&](auto& root, Use use) {
    if (root) f(root, use);
  };
  auto visitArguments = [&](const Body& callee, auto arguments) {
    size_t i = 0;
    for (const Local& parameter : parameters(callee)) {
      if (i == arguments.size()) break;
      visit(arguments[i++], parameter.kind == LocalKind::Input ? Use::Read : Use::Reference);
    }
  };
#undef RUNG_READ
#undef RUNG_WRITE
#undef RUNG_REFERENCE
#undef RUNG_ARGUMENTS
#define RUNG_READ(name) visit(node.name, Use::Read);
#define RUNG_WRITE(name) visit(node.name, Use::Write);
#define RUNG_REFERENCE(name) visit(node.name, Use::Reference);
#define RUNG_ARGUMENTS(name) visitArguments(module.body(node.callee), body.list(node.name));
#define RUNG_STMT(kind, word, effect, flow, fields)               \
  case StmtKind::kind: {                                          \
    [[maybe_unused]] auto& node = stmt.template as<kind##Stmt>(); \
    fields return;                                                \
  }
  switch (stmt.kind) {
#include "ir/instructions.def"
  }
#undef RUNG_READ
#undef RUNG_WRITE
#undef RUNG_REFERENCE
#undef RUNG_ARGUMENTS
#define RUNG_READ(name)
#define RUNG_WRITE(name)
#define RUNG_REFERENCE(name)
#define RUNG_ARGUMENTS(name)
}

// f(StmtId& first): the first statement of each block that a statement holds, in order; none for an empty block.
template <class BodyT, class StmtT, class F>
void forEachBlock(BodyT& body, StmtT& stmt, F&& f) {
#undef RUNG_BLOCK
#undef RUNG_CASES
#define RUNG_BLOCK(name) f(node.name);
#define RUNG_CASES(name) \
  for (auto& one : body.list(node.name)) f(one.block);
#define RUNG_STMT(kind, word, effect, flow, fields)               \
  case StmtKind::kind: {                                          \
    [[maybe_unused]] auto& node = stmt.template as<kind##Stmt>(); \
    fields return;                                                \
  }
  switch (stmt.kind) {
#include "ir/instructions.def"
  }
}
#undef RUNG_OPERAND
#undef RUNG_OPERANDS
#undef RUNG_READ
#undef RUNG_WRITE
#undef RUNG_REFERENCE
#undef RUNG_ARGUMENTS
#undef RUNG_BLOCK
#undef RUNG_CASES
#undef RUNG_VALUE
// NOLINTEND(bugprone-macro-parentheses)

// f(StmtId): every statement from `first` on, and those in their blocks, each before its blocks.
template <class F>
void forEachStmt(const Body& body, StmtId first, F&& f) {
  for (StmtId id = first; id; id = body.stmt(id).next) {
    f(id);
    forEachBlock(body, body.stmt(id), [&](StmtId block) { forEachStmt(body, block, f); });
  }
}

// The place that a Field, Index or Bits is a part of; none for other kinds.
inline ExprId baseOf(const Expr& place) {
  if (const auto* field = place.tryAs<FieldExpr>()) return field->base;
  if (const auto* index = place.tryAs<IndexExpr>()) return index->base;
  if (const auto* bits = place.tryAs<BitsExpr>()) return bits->base;
  return {};
}

// The condition of `if condition { break }`; none of other statements.
inline ExprId exitTest(const Body& body, StmtId id) {
  const auto* test = id ? body.stmt(id).tryAs<IfStmt>() : nullptr;
  if (test == nullptr || test->else_block || !test->then_block) return {};
  const Stmt& inner = body.stmt(test->then_block);
  return inner.kind == StmtKind::Break && !inner.next ? test->condition : ExprId{};
}

// Tells whether the evaluation of a tree may fault.
inline bool mayFault(const Body& body, ExprId root) {
  const Expr& expr = body.expr(root);
  bool found = expr.checks != 0;
  forEachOperand(body, expr, [&](ExprId operand) { found = found || mayFault(body, operand); });
  return found;
}

// A Field that is a reference: the variable that it refers to may be anywhere.
inline bool isReference(const Module& module, const Body& body, const Expr& place) {
  const auto* field = place.tryAs<FieldExpr>();
  if (field == nullptr) return false;
  return module.types.info(module.types.resolve(body.expr(field->base).type)).fields[field->field].by_reference;
}

// The variable at the root of a place.
inline ExprId rootOf(const Body& body, ExprId place) {
  while (const ExprId base = baseOf(body.expr(place))) place = base;
  return place;
}

}  // namespace rung::ir
