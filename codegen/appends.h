// SPDX-License-Identifier: Apache-2.0
// Appended texts: `line := CONCAT(line, DINT_TO_STRING(n))` makes the text of `n` in a temporary and copies it to the
// end of the line. Where nothing else reads the temporary, the text is made at the end of the line at once. In: the
// measured strings of a body, and where their lengths are known. Out: the statements that make such a text. Called by
// analysis.cpp; written by calls.cpp.
//
// Without it (tests/bench/run.sh kernels) `builder` takes 1.3 times as long.
#pragma once

#include <vector>

#include "codegen/lengths.h"

namespace rung::codegen {

struct Appends {
  // By statement: for the call that makes the text, the statement after it, which appends it; for that one, itself.
  std::vector<ir::StmtId> appended_by;
  std::vector<uint8_t> needs_no_memory;  // by local: such a temporary

  ir::StmtId find(ir::StmtId id) const { return id.index < appended_by.size() ? appended_by[id.index] : ir::StmtId{}; }
  bool has(uint32_t local) const { return local < needs_no_memory.size() && needs_no_memory[local] != 0; }
};

Appends analyzeAppends(const StringsOfBody& strings, const KnownLengths& lengths);

}  // namespace rung::codegen
