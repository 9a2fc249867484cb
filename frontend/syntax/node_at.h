// SPDX-License-Identifier: Apache-2.0
// The nodes at a location, for editors and debuggers. In: the tree of a file and a byte of it. Out: the innermost node
// whose source has this byte, and the nodes around it. Binary search in lists of declarations, statements and
// expressions, so that a long file costs microseconds.
#pragma once

#include <vector>

#include "frontend/syntax/tree.h"

namespace rung {

// A node of any category.
struct NodeRef {
  enum class Category : uint8_t { None, Decl, Stmt, Expr, TypeExpr };

  NodeRef() = default;
  NodeRef(DeclId id) : category(Category::Decl), word(id.word) {}
  NodeRef(StmtId id) : category(Category::Stmt), word(id.word) {}
  NodeRef(ExprId id) : category(Category::Expr), word(id.word) {}
  NodeRef(TypeExprId id) : category(Category::TypeExpr), word(id.word) {}
  explicit operator bool() const { return category != Category::None; }
  friend bool operator==(NodeRef, NodeRef) = default;

  Category category = Category::None;
  uint32_t word = 0;
};

// Calls `visit` with the id of the node.
template <class Visit>
void withId(NodeRef node, Visit&& visit) {
  switch (node.category) {
    case NodeRef::Category::None: return;
    case NodeRef::Category::Decl: return visit(DeclId{node.word});
    case NodeRef::Category::Stmt: return visit(StmtId{node.word});
    case NodeRef::Category::Expr: return visit(ExprId{node.word});
    case NodeRef::Category::TypeExpr: return visit(TypeExprId{node.word});
  }
}

// The source of a node with all its children: its range (Tree::range), and of a POU also the members that follow its
// END_…. The second half of a property of edition 4 (in_halves) is outside of the property.
Range extentOf(const Tree& tree, NodeRef node);

// From the declaration of the file to the innermost node. Empty: between declarations.
std::vector<NodeRef> nodeAt(const Tree& tree, const FileUnit& unit, Loc at);

}  // namespace rung
