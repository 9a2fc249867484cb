// SPDX-License-Identifier: Apache-2.0
// The memory of a module: see memory.h.
#include "memory.h"

#include <algorithm>
#include <cstring>

#include "crashes.h"

namespace rung::host {
namespace {

uint8_t* allocate(std::vector<std::unique_ptr<uint8_t[]>>& storage, size_t size, size_t align) {
  if (align == 0) align = 1;
  // Eight more bytes keep a 64-bit view at the end of an area inside.
  storage.push_back(std::make_unique<uint8_t[]>(size + align + 8));
  const uintptr_t address = reinterpret_cast<uintptr_t>(storage.back().get());
  return storage.back().get() + ((address + align - 1) / align * align - address);
}

}  // namespace

const char* refusal(const rung_module& module) {
  if (module.abi != RUNG_MODULE_ABI) return "the program was built for another version of the runtime; build it again";
  if (module.pointer_size != sizeof(void*)) return "the program was built for another pointer size (--target-pointer)";
  return nullptr;
}

Memory::Memory(const LoadedModule& module) : module_(module) {
  for (uint32_t i = 0; i < module.blocks.size(); ++i) {
    blocks_.push_back(allocate(storage_, module.blocks[i].size, module.blocks[i].align));
    block_pointers_.push_back(blocks_.back());
  }
  for (uint32_t i = 0; i < module.areas.size(); ++i) areas_.push_back(allocate(storage_, module.areas[i].size, 8));
  context_.blocks = block_pointers_.data();
  context_.areas = areas_.data();
  context_.module = &module.description;
  common_ = context_;
}

uint8_t Memory::end() { return run(module_.description.exit); }

uint8_t Memory::run(void (*function)(rung_context*)) {
  return function == nullptr ? uint8_t{RUNG_FAULT_NONE} : guarded(&context_, function);
}

uint8_t Memory::reset(bool keeps_inputs) {
  for (uint32_t i = 0; i < module_.blocks.size(); ++i) memset(blocks_[i], 0, module_.blocks[i].size);
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
  for (uint32_t i = 0; i < module_.blocks.size(); ++i) archive.bytes(blocks_[i], module_.blocks[i].size);
  for (uint32_t i = 0; i < module_.areas.size(); ++i) archive.bytes(areas_[i], module_.areas[i].size);
  size_t kept = kept_outputs_.size();
  archive.value(kept);
  kept_outputs_.resize(kept);
  for (std::vector<uint8_t>& area : kept_outputs_) archive.list(area);
  rung_context& c = context_;
  archive.values(c.now_ns, c.entry, c.task, c.activation, c.fault, c.callers, c.caller_count);
}

void Memory::restoreOutputs() {
  for (uint32_t i = 0; i < kept_outputs_.size(); ++i)
    if (module_.areas[i].owner == RUNG_AREA_OUTPUT)
      std::copy(kept_outputs_[i].begin(), kept_outputs_[i].end(), areas_[i]);
  kept_outputs_.clear();
}

}  // namespace rung::host
