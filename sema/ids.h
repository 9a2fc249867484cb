// SPDX-License-Identifier: Apache-2.0
// Ids of resolved entities: indices into the tables of entities.h. 0: none.
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

}  // namespace rung::sema
