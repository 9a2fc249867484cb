// Where the accumulator of an instruction list is read, which instructions are reached, and where labels are. In: the
// instructions, and the signatures of what they call. Called by il_schedule.cpp before it makes statements of them.
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
  // Of each instruction the one that reads the value which stands in the accumulator before it, or none. The number of
  // instructions stands for the end of a nested list, which takes the value out.
  std::vector<uint32_t> reader;
  std::vector<bool> reached;                          // from the beginning
  std::vector<uint32_t> jumps;                        // how many lead to the label of an instruction
  std::vector<NameId> temporary;                      // in which they bring the accumulator; named by the scheduler
  std::vector<std::pair<uint32_t, uint32_t>> labels;  // name key, instruction; sorted

  uint32_t labelOf(const Names& names, const Ident& target) const;
};

// Reports labels that stand twice.
IlFlow flowOf(const Tree& tree, const Names& names, Diagnostics& diagnostics, Signatures& signatures,
              Slice<IlInstruction> list, bool nested);

// Whether the accumulator is the first argument of a function.
bool takesAccumulator(Signatures& signatures, const IlInstruction& i);
// `CU counter`: the input of an instance that a function's name, or LD, S or R, stands for. Null: it is none.
const NameId* inputOperator(const Tree& tree, const Names& names, Signatures& signatures, const IlInstruction& i);

}  // namespace rung::text
