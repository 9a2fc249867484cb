// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/clone.h"

#include <vector>

#include "frontend/syntax/children.h"

namespace rung {
namespace {

// A node of the same kind, whose fields are those of the original.
ExprId copyNode(Tree& tree, ExprId expr) {
  // clang-format off
  switch (tree.kind(expr)) {
#define RUNG_EXPR(kind, word, shape, ...) \
  case ExprKind::kind:                    \
    return tree.add<ExprId>(kind##Expr(tree.as<kind##Expr>(expr)));
#include "frontend/syntax/nodes.def"
  }
  // clang-format on
  return {};
}

// Gives a copied node copies of its lists, so that its children can be replaced by theirs.
struct CopyLists {
  Tree& tree;
  template <class T>
  void operator()(Slice<T>& list) const {
    list = tree.addList<T>(tree.list(list));
  }
  template <class Id>
  void operator()(Id&) const {}
};

}  // namespace

ExprId clone(Tree& tree, ExprId expr) {
  RUNG_INVARIANT(shape(tree.kind(expr)) != ExprShape::Inserted, "only what a parser made is copied");
  const ExprId copy = copyNode(tree, expr);
  if (tree.expr(expr).in_parens != 0) {
    const Range range = tree.range(expr);
    tree.parenthesize(copy, range.begin, range.end);
  }
  forEachField(tree, copy, CopyLists{tree});
  forEachOperand(tree, copy, [&](ExprId& operand) { operand = clone(tree, operand); });
  return copy;
}

bool isPlainPath(const Tree& tree, ExprId expr) {
  const ExprShape of = shape(tree.kind(expr));
  if (of != ExprShape::Step) return of == ExprShape::Leaf && tree.kind(expr) != ExprKind::Error;
  return !anyOperand(tree, expr, [&](ExprId operand) { return !isPlainPath(tree, operand); });
}

bool hasCall(const Tree& tree, ExprId expr) {
  const ExprKind kind = tree.kind(expr);
  if (kind == ExprKind::Call || kind == ExprKind::New || kind == ExprKind::Assign) return true;
  return shape(kind) != ExprShape::Inserted &&
         anyOperand(tree, expr, [&](ExprId operand) { return hasCall(tree, operand); });
}

}  // namespace rung
