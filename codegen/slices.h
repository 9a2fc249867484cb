// SPDX-License-Identifier: Apache-2.0
// Slices: strings that need no memory while the body runs, because they are parts of strings that do not change.
// In `rest := MID(rest, LEN(rest) - at, at + 1)` nothing moves: the address and the length of `rest` change, and at the
// exits and in the fault block its characters are copied into the instance, once. A string becomes a slice when
//   - its length lives in a local (lengths.h), and functions marked {slice} (LEFT, RIGHT, MID) make it in a loop;
//   - every write makes it a part of a literal, of another slice, or of a string that this body never writes;
//   - every read comes after a write of it, and takes a length: a slice has no NUL at its end;
//   - at least one write makes it from a slice, itself or another: a string is taken apart piece by piece. Pieces of an
//     unchanging string that stay whole are copied: a store or two, and a single character stays in a register;
//   - the body calls nothing that may fault or that the host may answer, so only its own code leaves it.
// The sources of slices do not change, so slices may be written back in any order.
//
// Also a slice is a temporary that one statement makes and only the next one reads, by a function that takes a length.
//
// In: uses and measured strings of a body. Out: a flag for each variable. Called by analysis.cpp; written by
// measured.cpp, strings.cpp and calls.cpp.
//
// Without it (tests/bench/run.sh kernels, --checks=none) `telegram` takes 2.3 times as long.
#pragma once

#include "codegen/lengths.h"

namespace rung::codegen {

struct Slices {
  std::vector<uint8_t> is_slice;  // by variable; empty without any

  bool has(uint32_t variable) const { return !is_slice.empty() && variable != kNoVariable && is_slice[variable] != 0; }
  std::string toString(const Variables& variables) const;
};

Slices analyzeSlices(const StringsOfBody& strings, const Facts& facts, const Uses& uses);

// A string without the conversions that cut it.
ir::ExprId uncut(const ir::Module& module, const ir::Body& body, ir::ExprId id);

}  // namespace rung::codegen
