// SPDX-License-Identifier: Apache-2.0
// The lists of globals and the program instances of a module, and the variables and paths that a host finds in them.
// In: the project's lists, instances, addresses and access paths. Out: Module::lists, programs, located and
// access_paths. A part of ModuleLowering (lowering.h).
#pragma once

#include <unordered_map>
#include <vector>

#include "ir/lower/body_part.h"
#include "ir/lower/module_part.h"

namespace rung::ir {

class InstanceLowering : ModulePart {
 public:
  explicit InstanceLowering(ModuleLowering& of);

  void addLists();
  void addPrograms();
  void addLocated();
  void addAccessPaths();
  // Lists and instances as known while the project is being checked, without their memory and code.
  void addNames();

  uint32_t listIndex(sema::ListId list) const { return list_index_[list.index]; }
  // Tells whether this list is initialised after the others.
  bool isLast(sema::ListId list) const { return list_index_[list.index] == last_list_; }
  // The instance that a program's name means; created when the program has none.
  uint32_t instanceOf(sema::PouId program);
  // Tells whether the module has the project's instance, and its index in Module::programs.
  bool isCreated(uint32_t instance) const { return program_of_[instance] != 0; }
  uint32_t programOf(uint32_t instance) const { return program_of_[instance] - 1; }
  std::vector<Root> roots() const;  // the lists, then the programs but for tests

 private:
  std::vector<uint32_t> list_index_;                    // by ListId
  uint32_t last_list_ = 0;                              // index in Module::lists
  std::vector<uint32_t> program_of_;                    // by sema instance: index in Module::programs + 1
  std::unordered_map<uint32_t, uint32_t> instance_of_;  // by PouId: index in Module::programs
};

}  // namespace rung::ir
