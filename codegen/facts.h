// SPDX-License-Identifier: Apache-2.0
// Facts about the whole module that codegen needs before it writes a body: block numbers, which bodies are inlined,
// and which fields other code than their own block may reach while that block runs.
// In: the module. Out: tables by index. Called once by emit.cpp, read by all others.
//
// Without inlined bodies `cascade`, which calls LIMIT, executes 11 % more instructions in a project of several files
// (tests/bench/run.sh kernels); where all code is in one file, g++ inlines them by itself.
#pragma once

#include <vector>

#include "ir/description.h"
#include "ir/exposure.h"

namespace rung::codegen {

struct Facts : ir::MemoryBlocks {
  // `across_pous`: bodies of the project are inlined too, so that what calls them depends on their text.
  Facts(const ir::Module& module, bool across_pous);

  std::vector<uint8_t> is_inlined;  // by body: a small pure function or block, in its own header

  std::vector<uint8_t> is_zeroing;  // by body: an initialiser that only clears its record; none is generated
  std::vector<uint8_t> is_pointed;  // by record: the target of some POINTER or REFERENCE

  ir::Exposure exposure;

 private:
  bool onlyClears(const ir::Module& module, ir::BodyId id);
};

}  // namespace rung::codegen
