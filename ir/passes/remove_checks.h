// SPDX-License-Identifier: Apache-2.0
// Range analysis: clears the checks (div, index, null, subrange, convert, overflow) that intervals prove. Intervals
// come from types and subranges, constants, arithmetic (MOD, AND masks), FOR bounds, comparisons and CASE values that
// dominate the use, and from checks: what comes after one has passed it. Of a pointer they tell whether it is null.
// They are kept for private locals and for the scalar fields of self, until something may have written them: a call
// that reaches self (effects.h), or, for a field whose address is taken, any other call or a write through a pointer,
// reference or global. What a loop only counts moves as often as the loop runs (counters.h). For a check g++ needs two
// blocks and an exit, 6 % of its time on 100 000 lines.
//   needs  verified IR; proves more after folding and propagation
//   keeps  everything but check flags and the sign of divisions by a constant, which costs instructions; bodies with
//          labels as they are
//   gives  `h[idx - 1]` without check in `FOR idx := 15 TO 1 BY -1` on [0..15]; `a[i MOD 8]` on unsigned i;
//          `WHILE i < 15 AND a[i] <> 0` and `a[n] := x; n := n + 1;` in a FOR without check; the second of `a[i]` and
//          `b[i]`; `m[=i, k]!`, which checks k; `convert int (mod uint (convert uint i), uint#8)` for `i MOD 8` where i
//          is not negative
//   cost   nothing for a body without checks and divisions; else one walk, a few more of a loop with checks, and one
//          array over locals and fields of self
#pragma once

#include "ir/exposure.h"
#include "ir/ir.h"

namespace rung::ir {

bool removeChecks(Module& module, const Exposure& exposure, Body& body);  // true when something changed

}  // namespace rung::ir
