// SPDX-License-Identifier: Apache-2.0
// Which fields of the instance live in C++ locals: scalars that nothing else can reach while the body runs and that it
// uses often are loaded at entry, and written back at the exits and in the fault block. In: the uses of a body. Out: a
// flag for each variable. Called by analysis.cpp.
//
// Without it (tests/bench/run.sh kernels, --checks=none) `transform` takes 2.5 times as long, `linear` 1.8 times,
// `recipes` 1.7 times, `filter` 1.3 times.
#pragma once

#include "codegen/uses.h"

namespace rung::codegen {

struct CachedFields {
  std::vector<uint8_t> is_cached;  // by variable

  std::string toString(const Variables& variables) const;
};

CachedFields analyzeLocals(const ir::Module& module, const Facts& facts, const Uses& uses);

}  // namespace rung::codegen
