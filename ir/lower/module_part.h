// SPDX-License-Identifier: Apache-2.0
// The parts of the lowering of a module share this: the project that they read and the module that they fill. The base
// of RecordLowering, InstanceLowering and TaskLowering.
#pragma once

namespace rung::sema {
struct Project;
}
namespace rung::types {
class TypeTable;
}

namespace rung::ir {

struct Module;
struct ModuleLowering;

struct ModulePart {
  explicit ModulePart(ModuleLowering& of);

  ModuleLowering& all;
  const sema::Project& project;
  Module& module;
  types::TypeTable& types;
};

}  // namespace rung::ir
