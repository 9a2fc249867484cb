// SPDX-License-Identifier: Apache-2.0
// The memory of a module: see memory.h.
#include "memory.h"

#include <algorithm>
#include <cstring>

#include "crashes.h"

namespace rung::host {
const char* refusal(const rung_module& module) {
  if (module.abi != RUNG_MODULE_ABI) return "the program was built for another version of the runtime; build it again";
  if (module.pointer_size != sizeof(void*)) return "the program was built for another pointer size (--target-pointer)";
  return nullptr;
}

Memory::Part Memory::allocate(size_t size, size_t align) {
  if (align == 0) align = 1;
  // Eight more bytes keep a 64-bit view at the end of an area inside.
  Part part;
  part.storage = std::shared_ptr<uint8_t[]>(new uint8_t[size + align + 8]());
  const uintptr_t address = reinterpret_cast<uintptr_t>(part.storage.get());
  part.begin = part.storage.get() + ((address + align - 1) / align * align - address);
  return part;
}

Memory::Memory(const LoadedModule& module) : module_(module) {
  for (const rung_block& block : module.blocks) block_parts_.push_back(allocate(block.size, block.align));
  for (const rung_area& area : module.areas) area_parts_.push_back(allocate(area.size, 8));
  describe();
}

Memory::Memory(const LoadedModule& module, const Memory& before, const std::vector<uint32_t>& kept) : module_(module) {
  for (uint32_t i = 0; i < module.blocks.size(); ++i)
    block_parts_.push_back(kept[i] != RUNG_NONE ? before.block_parts_[kept[i]]
                                                : allocate(module.blocks[i].size, module.blocks[i].align));
  for (uint32_t i = 0; i < module.areas.size(); ++i) {
    const uint32_t size = module.areas[i].size;
    const bool is_same = i < before.module_.areas.size() && before.module_.areas[i].size == size;
    area_parts_.push_back(is_same ? before.area_parts_[i] : allocate(size, 8));
  }
  describe();
  context_.now_ns = before.context_.now_ns;
  context_.host = before.context_.host;
  context_.host_data = before.context_.host_data;
  context_.step_limit = before.context_.step_limit;
}

void Memory::describe() {
  for (const Part& block : block_parts_) blocks_.push_back(block.begin);
  for (const Part& area : area_parts_) areas_.push_back(area.begin);
  context_.blocks = blocks_.data();
  context_.areas = areas_.data();
  context_.module = &module_.description;
  common_ = context_;
}

uint8_t Memory::end() { return run(module_.description.exit); }

uint8_t Memory::run(void (*function)(rung_context*)) {
  return function == nullptr ? uint8_t{RUNG_FAULT_NONE} : guarded(&context_, function);
}

uint8_t Memory::reset(bool keeps_inputs) {
  for (uint32_t i = 0; i < module_.blocks.size(); ++i) memset(block(i), 0, module_.blocks[i].size);
  for (uint32_t i = 0; i < module_.areas.size(); ++i)
    if (!keeps_inputs || module_.areas[i].owner != RUNG_AREA_INPUT) memset(areas_[i], 0, module_.areas[i].size);
  kept_outputs_.clear();
  context_.now_ns = 0;
  context_.task = context_.activation = 0;
  context_.fault = {};
  return run(module_.description.init);
}

// The program's function writes into areas of its own.
void Memory::safeOutputs(std::vector<std::vector<uint8_t>>& areas) const {
  rung_context context = context_;
  std::vector<uint8_t*> pointers;
  areas.clear();
  for (uint32_t i = 0; i < module_.areas.size(); ++i) areas.emplace_back(module_.areas[i].size + 8);
  for (std::vector<uint8_t>& area : areas) pointers.push_back(area.data());
  context.areas = pointers.data();
  context.stop = RUNG_STOP_NONE;
  context.steps = context.step_limit;
  if (module_.description.safe != nullptr) guarded(&context, module_.description.safe);
}

void Memory::makeOutputsSafe() {
  if (!kept_outputs_.empty()) return;
  std::vector<std::vector<uint8_t>> areas;
  safeOutputs(areas);
  for (uint32_t i = 0; i < module_.areas.size(); ++i) {
    kept_outputs_.emplace_back(areas_[i], areas_[i] + module_.areas[i].size);
    if (module_.areas[i].owner == RUNG_AREA_OUTPUT) std::copy_n(areas[i].begin(), module_.areas[i].size, areas_[i]);
  }
}

void Memory::transfer(StateArchive& archive) {
  for (uint32_t i = 0; i < module_.blocks.size(); ++i) archive.bytes(block(i), module_.blocks[i].size);
  for (uint32_t i = 0; i < module_.areas.size(); ++i) archive.bytes(areas_[i], module_.areas[i].size);
  size_t kept = kept_outputs_.size();
  archive.value(kept);
  kept_outputs_.resize(kept);
  for (std::vector<uint8_t>& area : kept_outputs_) archive.list(area);
  rung_context& c = context_;
  archive.values(c.now_ns, c.entry, c.task, c.activation, c.fault, c.callers, c.caller_count);
}

size_t Memory::bytes() const {
  size_t all = sizeof context_;
  for (const rung_block& block : module_.blocks) all += block.size;
  for (const rung_area& area : module_.areas) all += area.size;
  return all;
}

void Memory::restoreOutputs() {
  for (uint32_t i = 0; i < kept_outputs_.size(); ++i)
    if (module_.areas[i].owner == RUNG_AREA_OUTPUT)
      std::copy(kept_outputs_[i].begin(), kept_outputs_[i].end(), areas_[i]);
  kept_outputs_.clear();
}

}  // namespace rung::host
