// SPDX-License-Identifier: Apache-2.0
// Lists of globals, program instances and what they name in memory: see instances.h.
#include <algorithm>

#include "ir/lower/lowering.h"

namespace rung::ir {

InstanceLowering::InstanceLowering(ModuleLowering& of) : ModulePart(of) {
  list_index_.resize(project.global_lists.size());
}

void InstanceLowering::addLists() {
  std::vector<std::pair<std::string, uint32_t>> order;
  for (uint32_t i = 1; i < project.global_lists.size(); ++i)
    if (project.global_lists[i].record)
      order.push_back({foldedIdentifier(project.names.string(project.global_lists[i].name)), i});
  std::sort(order.begin(), order.end());
  for (const auto& [name, index] : order) {
    const sema::GlobalList& list = project.global_lists[index];
    list_index_[index] = static_cast<uint32_t>(module.lists.size());
    all.records.declare(list.record);
    module.lists.push_back({list.name, list.record, {}, list.init_slot, list.resource ? list.configuration : NameId{}});
    if (list.init_slot >= module.lists[last_list_].slot) last_list_ = list_index_[index];
  }
}

std::vector<Root> InstanceLowering::roots() const {
  std::vector<Root> all;
  for (uint32_t i = 0; i < module.lists.size(); ++i) all.push_back({true, i, module.lists[i].record});
  for (uint32_t i = 0; i < module.programs.size(); ++i)
    if (!module.programs[i].is_test) all.push_back({false, i, module.programs[i].record});
  return all;
}

void InstanceLowering::addNames() {
  for (uint32_t i = 1; i < project.global_lists.size(); ++i) {
    list_index_[i] = static_cast<uint32_t>(module.lists.size());
    module.lists.push_back({project.global_lists[i].name, project.global_lists[i].record, {}});
  }
  for (const sema::ProgramInstance& instance : project.instances) {
    const auto index = static_cast<uint32_t>(module.programs.size());
    program_of_.push_back(index + 1);
    instance_of_.insert({instance.program.index, index});
    module.programs.emplace_back().name = instance.name;
    module.programs.back().record = project.pou(instance.program).record;
  }
}

void InstanceLowering::addPrograms() {
  program_of_.resize(project.instances.size());
  for (const sema::ProgramInstance& instance : project.instances) {
    if (!instance.program) continue;
    program_of_[static_cast<size_t>(&instance - project.instances.data())] =
        static_cast<uint32_t>(module.programs.size()) + 1;
    const sema::Pou& pou = project.pou(instance.program);
    ProgramInstance created;
    created.name = instance.name;
    created.record = pou.record;
    created.slot = pou.pragmas.init_slot;
    created.task = instance.task;
    created.retain = instance.retain;
    created.resource = instance.resource;
    created.configuration = instance.configuration;
    instance_of_.insert({instance.program.index, static_cast<uint32_t>(module.programs.size())});
    module.programs.push_back(created);
    module.programs.back().body = all.bodyOf(instance.program);
  }
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    const bool is_called = pou.kind == PouKind::Program && pou.pragmas.after_globals;
    if ((pou.pragmas.test || is_called) && !pou.excluded && pou.record) instanceOf({i});
    if (pou.pragmas.safe_values && !pou.excluded) module.safe = all.bodyOf({i});
    if (pou.pragmas.setup && !pou.excluded) module.setups.push_back(all.bodyOf({i}));
    if (pou.pragmas.teardown && !pou.excluded) module.teardowns.push_back(all.bodyOf({i}));
  }
}

uint32_t InstanceLowering::instanceOf(sema::PouId program) {
  auto known = instance_of_.find(program.index);
  if (known != instance_of_.end()) return known->second;
  const sema::Pou& pou = project.pou(program);
  uint32_t index = static_cast<uint32_t>(module.programs.size());
  instance_of_[program.index] = index;
  ProgramInstance created;
  created.name = pou.pragmas.test ? pou.unique_name : pou.name;
  created.record = pou.record;
  created.slot = pou.pragmas.init_slot;
  module.programs.push_back(created);
  BodyId body = all.bodyOf(program);
  module.programs[index].body = body;
  module.programs[index].is_test = pou.pragmas.test;
  return index;
}

void InstanceLowering::addAccessPaths() {
  for (const sema::AccessPath& path : project.access_paths) {
    if (path.root == sema::AccessPath::Root::Instance && !isCreated(path.index)) continue;
    AccessPath created;
    created.name = path.name;
    created.prefix = path.prefix;
    created.configuration = path.configuration;
    created.type = types.resolve(path.type);
    created.read_only = path.read_only;
    if (path.located) {
      created.index = path.image.area.index;
      created.offset = path.image.byte;
      if (path.image.is_bit) created.bit = path.image.bit;
    } else {
      const bool of_list = path.root == sema::AccessPath::Root::List;
      created.root = of_list ? AccessPath::Root::List : AccessPath::Root::Program;
      created.index = of_list ? listIndex({path.index}) : programOf(path.index);
      created.offset = path.offset;
      if (path.bit >= 0) created.bit = static_cast<uint32_t>(path.bit);
    }
    module.access_paths.push_back(created);
  }
}

void InstanceLowering::addLocated() {
  for (const sema::Var& var : project.vars) {
    if (var.storage != sema::Storage::Image || !var.name || var.external) continue;
    if (var.pou && project.pou(var.pou).excluded && !all.knownBodyOf(var.pou)) continue;
    Located created;
    created.name = var.name;
    created.type = types.resolve(var.type);
    created.area = var.image.area.index;
    created.byte = var.image.byte;
    created.bit = var.image.is_bit ? var.image.bit : kNoBit;
    created.symbol_access = var.symbol_access;
    created.retain = var.keeping.retain;
    created.persistent = var.keeping.persistent;
    if (var.pou && project.pou(var.pou).kind == PouKind::Program) created.owner_program = instanceOf(var.pou) + 1;
    if (!var.pou && var.list) {
      const sema::GlobalList& list = project.global_lists[var.list.index];
      created.list = list.name;
      if (list.resource) created.configuration = list.configuration;
    }
    module.located.push_back(created);
  }
}

}  // namespace rung::ir
