// SPDX-License-Identifier: Apache-2.0
// The description of the module (rung/module.h): tables of types, symbols, blocks, tasks, tests and check sites.
// In: the IR module, its facts, the groups after all bodies were written. Out: the code of `module.cpp` and
// `sites.cpp`, and `symbols.json`. A change inside a POU's body changes at most `sites.cpp`. All is constant: nothing
// of it is initialized at run time.
#pragma once

#include <string>
#include <vector>

#include "codegen/emit.h"
#include "codegen/facts.h"
#include "codegen/group.h"

namespace rung::codegen {

struct Description {
  std::string module, sites, symbols;
};
Description describe(const ir::Module& module, const EmitOptions& options, const Facts& facts,
                     const std::vector<Group>& groups, std::string_view name_space);

}  // namespace rung::codegen
