// SPDX-License-Identifier: Apache-2.0
// Ids of the syntax tree, and the ids with which a checked tree is annotated, opaque numbers to the tree itself.
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

// Annotation: a type. 0: none; 1: the Error type that silences followers.
struct TypeId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  friend bool operator==(TypeId, TypeId) = default;
};

// Annotation: what a name denotes, as an index into a table of that kind.
enum class EntityKind : uint8_t {
  None,
  Error,
  Var,  // local, pin, field, global
  Pou,
  Type,  // the index is a TypeId
  EnumValue,
  GlobalList,  // a GVL used as a qualifier
  Namespace,   // a library used as a qualifier
  Program,     // an instance of one
  Property,
};
struct Entity {
  uint32_t kind : 4 = 0;
  uint32_t index : 28 = 0;
  EntityKind entityKind() const { return static_cast<EntityKind>(kind); }
  static Entity of(EntityKind kind, uint32_t index) {
    Entity e;
    e.kind = static_cast<uint32_t>(kind) & 15u;
    e.index = index & 0xfffffffu;
    return e;
  }
  explicit operator bool() const { return kind != 0; }
};

// Annotation: a resolved call. 0: not resolved.
struct CallId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
};

}  // namespace rung
