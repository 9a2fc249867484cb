// SPDX-License-Identifier: Apache-2.0
// The same logic twice: a generated function block as ST and as IL, each from one tree. In: a seed. Out: two sources
// with equal declarations and equal names, whose traces must be equal. Called by main.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rung::il_differential {

struct Twins {
  std::string st, il;
};

// The block `B<index>` of a seed. Its inputs are a … d (BOOL), i, j (DINT), k (INT), x (REAL); its outputs hold the
// results.
Twins generate(uint64_t seed, unsigned index);

}  // namespace rung::il_differential
