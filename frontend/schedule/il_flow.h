// SPDX-License-Identifier: Apache-2.0
// Where the accumulator of an instruction list is read, which instructions are reachable, and where labels are. In: the
// instructions, and the signatures of their callees. Called by il_schedule.cpp before it creates statements.
#pragma once

#include <utility>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/signatures.h"
#include "frontend/syntax/tree.h"

namespace rung::text {

constexpr uint32_t kNoInstruction = ~0u;

struct IlFlow {
  // For each instruction: the instruction that reads the value the accumulator has before it, or none. The number of
  // instructions denotes the end of a nested list, which reads the value.
  std::vector<uint32_t> reader;
  std::vector<bool> reached;      // reachable from the beginning
  std::vector<uint32_t> jumps;    // how many jump to the label of an instruction
  std::vector<NameId> temporary;  // in which jumps pass the accumulator to the label; named by the scheduler
  std::vector<std::pair<uint32_t, uint32_t>> labels;  // name key, instruction; sorted

  uint32_t labelOf(const Names& names, const Ident& target) const;
};

// Reports duplicate labels.
IlFlow flowOf(const Tree& tree, const Names& names, Diagnostics& diagnostics, Signatures& signatures,
              Slice<IlInstruction> list, bool nested);

// Tells whether the accumulator is the first argument of a function.
bool takesAccumulator(Signatures& signatures, const IlInstruction& i);
// `CU counter`: the input of an instance that the name of a function, or LD, S or R, denotes. Null: not an input
// operator.
const NameId* inputOperator(const Tree& tree, const Names& names, Signatures& signatures, const IlInstruction& i);

}  // namespace rung::text
