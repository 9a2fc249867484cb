// SPDX-License-Identifier: Apache-2.0
// The id of a type in the table of types.h.
#pragma once

#include <cstdint>

namespace rung {

// 0: none; 1: the Error type that silences followers.
struct TypeId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  friend bool operator==(TypeId, TypeId) = default;
};

}  // namespace rung
