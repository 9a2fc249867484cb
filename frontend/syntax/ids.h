// Ids of the syntax tree, and the ids that sema writes into it. The tree treats sema's ids as opaque numbers.
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

// A run of elements in the tree's list storage of that element type.
template <class T>
struct Slice {
  uint32_t first = 0, count = 0;
  bool empty() const { return count == 0; }
};

// Written by sema. TypeId: index in types::TypeTable; 0 none, 1 the Error type that silences followers.
struct TypeId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  friend bool operator==(TypeId, TypeId) = default;
};

// The entity that a name denotes; index is into the table of sema::Project that the kind names.
enum class EntityKind : uint8_t {
  None,
  Error,
  Var,         // Project::vars: local, pin, field, global
  Pou,         // Project::pous
  Type,        // index is a TypeId
  EnumValue,   // Project::enum_values
  GlobalList,  // Project::global_lists (a GVL used as a qualifier)
  Namespace,   // Project::namespaces (a library used as a qualifier)
  Program,     // Project::program_instances
  Property,    // Project::properties
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

// Index into Project::calls of a call that sema has resolved. 0: not resolved.
struct CallId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
};

}  // namespace rung
