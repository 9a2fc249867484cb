// SPDX-License-Identifier: Apache-2.0
// Rounding without the C library, which firmware may not have.
#pragma once

#include <stdint.h>

namespace rung::motion {

// To the nearest, halves away from 0; beyond +-limit that.
inline int64_t rounded(double value, double limit = 9e15) {
  if (!(value > -limit)) return static_cast<int64_t>(-limit);
  if (value >= limit) return static_cast<int64_t>(limit);
  return static_cast<int64_t>(value < 0 ? value - 0.5 : value + 0.5);
}

}  // namespace rung::motion
