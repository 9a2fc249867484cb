// SPDX-License-Identifier: Apache-2.0
// Ids of the syntax tree: of its nodes, of its lists, and names with their locations.
#pragma once

#include <cstdint>

#include "frontend/source/files.h"
#include "frontend/source/names.h"

namespace rung {

// A name with its location; the element of name lists.
struct Ident {
  NameId name;
  Loc loc;
};

// One id type per node category; the number is a word offset in the tree's arena. 0: none.
struct ExprId {
  uint32_t word = 0;
  explicit operator bool() const { return word != 0; }
  friend bool operator==(ExprId, ExprId) = default;
};
struct StmtId {
  uint32_t word = 0;
  explicit operator bool() const { return word != 0; }
  friend bool operator==(StmtId, StmtId) = default;
};
struct DeclId {
  uint32_t word = 0;
  explicit operator bool() const { return word != 0; }
  friend bool operator==(DeclId, DeclId) = default;
};
struct TypeExprId {
  uint32_t word = 0;
  explicit operator bool() const { return word != 0; }
  friend bool operator==(TypeExprId, TypeExprId) = default;
};

// A list in the tree's arena: the word of its first element. Empty: no word.
template <class T>
struct Slice {
  uint32_t first = 0, count = 0;
  bool empty() const { return count == 0; }
};

}  // namespace rung
