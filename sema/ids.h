// SPDX-License-Identifier: Apache-2.0
// Ids of resolved entities: indices into the tables of entities.h, 0: none; and what a name denotes.
#pragma once

#include <cstdint>

namespace rung::sema {

struct VarId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  friend bool operator==(VarId, VarId) = default;
};
struct PouId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  friend bool operator==(PouId, PouId) = default;
};
struct ListId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
};
// A resolved call.
struct CallId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
};

// What a name denotes, as an index into a table of that kind.
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

}  // namespace rung::sema
