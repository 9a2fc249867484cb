// SPDX-License-Identifier: Apache-2.0
// How much optimization a body deserves. In: a body. Out: which passes of the C++ compiler it gets.
// Called by body.cpp for each body.
//
// Most of the time of g++ -O2 goes into statements that run once per call, which gain little: a body is straight when
// its loops carry no more than kLoopShare times the work of its statements, and so is every initialiser. Small bodies
// (called or inlined in the loops of others), library bodies, bodies with labels (any of which may be a loop) and
// functions that work on strings (whose sized forms the quick passes do not inline) are never straight. Measured on 100
// 000 generated lines: g++ needs 0.4 of the time, the bodies run 1.0 to 1.2 times as long. Each definition carries the
// attribute: g++ applies a `#pragma GCC optimize` again to every declaration after it, which costs a tenth of its time.
// With `rung -O2` (EmitOptions::optimize_all) no body is straight.
#pragma once

#include "ir/ir.h"

namespace rung::codegen {

enum class Effort : uint8_t {
  Plain,         // as the command line asks
  Straight,      // RUNG_STRAIGHT
  Loops,         // RUNG_LOOPS
  CheckedLoops,  // RUNG_CHECKED_LOOPS: `medians` is 1.1 times as fast
};
Effort effortFor(const ir::Body& body, bool measures_strings);

}  // namespace rung::codegen
