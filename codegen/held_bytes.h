// SPDX-License-Identifier: Apache-2.0
// Coils: bytes of the process image that stay in a C++ variable from one store of a bit to the last. In: a verified
// body. Out: the bytes, and the statements between which each is held. Called by analysis.cpp; written by image.cpp.
//
// A ladder writes bit after bit of the same byte. Each store alone reads and writes the byte in memory, and waits for
// the store before it. Without this the cycle of tests/bench/nct.sh takes 1.2 times as long.
#pragma once

#include <vector>

#include "ir/ir.h"

namespace rung::codegen {

// From before `first` to after `last`, two statements of one block, nothing reaches the byte but what names its bits.
struct HeldByte {
  ir::StmtId first, last;
  uint32_t area = 0, byte = 0;
  uint8_t cleared = 0;  // bits that are written before anything reads them, and whatever happens
};

using HeldBytes = std::vector<HeldByte>;  // by their first statements, in the order of the text

HeldBytes analyzeHeldBytes(const ir::Module& module, const ir::Body& body);

}  // namespace rung::codegen
