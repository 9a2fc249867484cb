// SPDX-License-Identifier: Apache-2.0
// All that codegen knows of a body before a line of it is written: the results of the analyses, in the order in which
// they read each other. In: a verified body and the facts of the module. Out: BodyAnalysis. Called by body.cpp; the
// printer reads the results and decides nothing of this itself.
#pragma once

#include "codegen/appends.h"
#include "codegen/counted_loops.h"
#include "codegen/effort.h"
#include "codegen/held_bytes.h"
#include "codegen/slices.h"
#include "codegen/write_backs.h"

namespace rung::codegen {

struct BodyAnalysis {
  Uses uses;
  CachedFields fields;
  WriteBacks write_backs;
  CountedLoops loops;
  MeasuredStrings measured;
  Slices slices;
  KnownLengths lengths;
  Appends appends;
  HeldBytes held;
  Effort effort;
};

BodyAnalysis analyzeBody(const ir::Module& module, const ir::Body& body, const Facts& facts);

}  // namespace rung::codegen
