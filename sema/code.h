// SPDX-License-Identifier: Apache-2.0
// The code of a program as sema understands it. In: the statements of a body, or the expression of a declaration, as
// written or as a scheduler made them. Out: a copy in which everything is explicit: each expression has its Meaning
// beside it, conversions are ConvertExpr nodes, known values literals. What was written stays as it is.
#pragma once

#include <cstdint>
#include <span>

#include "frontend/syntax/tree_builder.h"
#include "sema/ids.h"
#include "sema/types/type_id.h"

namespace rung::sema {

// What sema knows of an expression.
struct Meaning {
  TypeId type;
  union {
    Entity entity;  // of a name; of a member: Var for a field or pin (its base is the record), else what `base.member`
                    // as a whole denotes
    CallId call;    // of a call; of __NEW: that of __SYSTEM.Allocate
  };
  ExprId written;             // what the source has in its place; none: nothing
  bool is_constant : 1;       // its value is known
  bool is_writable : 1;       // an lvalue that may be assigned
  bool writes_character : 1;  // of an index: a character of a string that is written
  bool is_bit_member : 1;     // of a bit: made for a member of type BIT; its base denotes the byte that contains it
  bool is_intermediate : 1;   // of an operation, of a conversion of an operand: intermediate.h
  bool rounds_from_zero : 1;  // of a conversion: types::Rounding::AwayFromZero
  bool leads_somewhere : 1;   // of the address of p^ for p[i]: a null p is a fault although nothing is read there
};

// What was written has no meaning, and does not change.
inline void requireCode([[maybe_unused]] const ExprHeader& node) {
#ifndef NDEBUG
  RUNG_INVARIANT(node.has_room != 0, "only code has a meaning, and may change");
#endif
}

class Code {
 public:
  explicit Code(Tree& arena) : arena_(arena) {}

  // ---- copies of what was written
  ExprId copy(ExprId written) const;
  StmtId copy(StmtId written) const;
  Slice<StmtId> copy(Slice<StmtId> written) const;
  Slice<Argument> copy(Slice<Argument> written) const;
  // A node of code with the same fields and the same meaning, for a second place.
  ExprId duplicate(ExprId of) const;
  // Puts `by`, or a duplicate of it if it is used elsewhere, into the place of another node.
  void replace(ExprId& slot, ExprId by) const;

  // ---- nodes of code, to be changed while they are checked
  template <class Node, class Id>
  Node& as(Id id) const {
    Node& node = arena_.as<Node>(id);
    if constexpr (std::is_same_v<Id, ExprId>) requireCode(node.h);
    return node;
  }
  ExprHeader& expr(ExprId id) const {
    requireCode(arena_.expr(id));
    return arena_.expr(id);
  }
  template <class T>
  std::span<T> list(Slice<T> slice) const {
    return arena_.list(slice);
  }
  template <class T>
  Slice<T> addList(std::span<const T> items) const {
    return arena_.addList<T>(items);
  }
  StringId addString(std::string_view text) const { return arena_.addString(text); }
  // Makes nodes that the source leaves implicit.
  TreeBuilder build() const;

 private:
  ExprId copyNode(ExprId of) const;

  Tree& arena_;
};

// The meaning of an expression of code, which lies in front of its node.
inline Meaning& meaning(const ExprHeader& node) {
  requireCode(node);
  return *(reinterpret_cast<Meaning*>(const_cast<ExprHeader*>(&node)) - 1);
}
inline Meaning& meaning(const Tree& tree, ExprId expr) { return meaning(tree.expr(expr)); }
inline TypeId& typeOf(const Tree& tree, ExprId expr) { return meaning(tree, expr).type; }

}  // namespace rung::sema
