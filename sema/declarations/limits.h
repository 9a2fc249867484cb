// SPDX-License-Identifier: Apache-2.0
// Limits of what declarations may nest.
#pragma once

#include "sema/context.h"

namespace rung::sema {

inline constexpr uint32_t kMaxDeclarationDepth = 500;
inline constexpr uint32_t kMaxTypeDepth = 2500;    // structures and blocks inside each other, arrays of arrays
inline constexpr uint32_t kMaxGenericDepth = 100;  // blocks with other generic constants inside each other
inline constexpr uint32_t kMaxBases = 500;         // bases of bases

}  // namespace rung::sema
