// How much work a body is worth to the C++ compiler. In: a body. Out: whether the cheap passes are enough for it.
// Called by body.cpp for each body.
//
// The time of g++ -O2 goes into statements that run once per call, and gains them little: a body is straight when its
// loops carry no more than kLoopShare times the work of its statements. Small bodies, which are called from the loops
// of others or written into them, and those of libraries are never straight, nor is one with labels, which may be any
// loop. Measured on 100 000 generated lines: g++ needs 0.45 of the time, the bodies run 1.0 to 1.2 times as long.
#pragma once

#include "ir/ir.h"

namespace rung::codegen {

bool isStraight(const ir::Body& body);

}  // namespace rung::codegen
