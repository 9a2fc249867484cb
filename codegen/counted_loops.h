// SPDX-License-Identifier: Apache-2.0
// Which FOR loops count in their control itself: those whose control only the loop writes, in a C++ local wide enough
// for one step beyond the limit, which makes a plain C++ loop that g++ can vectorize. In: the uses of a body and its
// cached fields. Out: those loops, and the widths of the controls. Called by analysis.cpp; written by loops.cpp.
//
// Without it (tests/bench/run.sh kernels, --checks=none) `transform` takes 2.5 times as long, `linear` 1.7 times,
// `recipes` 1.6 times, `filter` 1.3 times.
#pragma once

#include "codegen/locals.h"

namespace rung::codegen {

struct CountedLoop {
  ir::StmtId loop;
  bool fits = false;  // the control never takes a value outside of its type
};

struct CountedLoops {
  std::vector<CountedLoop> loops;  // by statement
  std::vector<uint8_t> wide;       // by variable: 32 or 64 when the C++ local is wider than the type, else 0

  const CountedLoop* find(ir::StmtId loop) const;
  std::string toString(const Variables& variables) const;
};

CountedLoops analyzeLoops(const ir::Module& module, const ir::Body& body, const Uses& uses, const CachedFields& fields);

}  // namespace rung::codegen
