// SPDX-License-Identifier: Apache-2.0
// Copies of shared memory for tasks: see exchange.h.
#include "exchange.h"

#include <algorithm>
#include <cstring>
#include <mutex>

namespace rung::host {
namespace {

constexpr uint32_t kScanned = 64;  // bytes

size_t words(size_t bytes) { return bytes / 8 + 2; }  // a 64-bit view at the end stays inside

void copyBits(uint8_t* to, const uint8_t* from, const rung_write& part) {
  to += part.offset;
  from += part.offset;
  if (part.mask == 255)
    memcpy(to, from, part.size);
  else
    *to = static_cast<uint8_t>((*to & ~part.mask) | (*from & part.mask));
}

}  // namespace

Exchange::Exchange(const Symbols& symbols, Memory& memory) : module_(symbols.module()), memory_(memory) {
  const auto takes_time = [](const rung_task& task) { return task.duration_ns > 0; };
  if (module_.tasks.size() < 2 && !std::any_of(module_.tasks.begin(), module_.tasks.end(), takes_time)) return;
  if ((module_.description.flags & RUNG_ALIGNED_GLOBALS) != 0 || module_.resources.size() > 1) findGlobals(symbols);
  copies_.resize(module_.tasks.size());
  for (Copy& copy : copies_) {
    for (uint32_t i = 0; i < module_.areas.size(); ++i) {
      copy.storage.emplace_back(words(module_.areas[i].size));
      copy.areas.push_back(reinterpret_cast<uint8_t*>(copy.storage.back().data()));
      const bool is_shared = module_.areas[i].owner == RUNG_AREA_SHARED;
      copy.taken.emplace_back(is_shared ? copy.storage.back().size() : 0);
    }
    for (uint32_t i = 0; i < module_.blocks.size(); ++i) copy.blocks.push_back(memory.block(i));
    for (const Globals& globals : globals_) {
      copy.storage.emplace_back(words(module_.blocks[globals.block].size));
      copy.blocks[globals.block] = copy.storage.back().data();
      copy.before.emplace_back(words(module_.blocks[globals.block].size));
    }
  }
}

// The elementary variables of the lists of globals, in runs of equal size, and the bytes between them, which hold what
// blocks know of themselves.
void Exchange::findGlobals(const Symbols& symbols) {
  std::vector<Variable> leaves;
  std::vector<std::pair<uint32_t, Run>> runs;
  for (uint32_t i = 0; i < module_.symbols.size(); ++i) {
    const rung_symbol& symbol = module_.symbols[i];
    if (symbol.storage != RUNG_IN_BLOCK || symbol.is_program != 0 || (symbol.flags & RUNG_FIELD_CONSTANT) != 0)
      continue;
    leaves.clear();
    symbols.expand(symbols.root(i), leaves);
    for (const Variable& leaf : leaves)
      if (leaf.pointers == 0)
        runs.push_back({symbol.index, {leaf.offsets[0], leaf.bit != 255 ? 1 : leaf.type->size, 1}});
  }
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second.offset < b.second.offset;
  });
  for (const auto& [block, run] : runs) {
    if (globals_.empty() || globals_.back().block != block) {
      closeGlobals();
      globals_.push_back({block, {}});
    }
    addRun(run);
  }
  closeGlobals();
}

void Exchange::addRun(const Run& run) {
  std::vector<Run>& known = globals_.back().runs;
  const uint32_t end = known.empty() ? 0 : known.back().offset + known.back().size * known.back().count;
  if (run.offset < end) return;  // bits of one byte, views of one variable
  if (run.offset > end) {
    known.push_back({end, 1, run.offset - end});
    known.push_back(run);
  } else if (!known.empty() && run.size == known.back().size) {
    known.back().count += run.count;
  } else {
    known.push_back(run);
  }
}

void Exchange::closeGlobals() {
  if (!globals_.empty()) addRun({module_.blocks[globals_.back().block].size, 1, 0});
}

void Exchange::transfer(StateArchive& archive) {
  const auto contents = [&](std::vector<std::vector<uint64_t>>& all) {
    for (std::vector<uint64_t>& one : all) archive.bytes(one.data(), one.size() * sizeof one[0]);
  };
  for (Copy& copy : copies_) {
    contents(copy.storage);
    contents(copy.taken);
    contents(copy.before);
  }
}

void Exchange::take(uint32_t task, rung_context& context) {
  if (copies_.empty()) return;
  Copy& copy = copies_[task];
  const std::lock_guard<PriorityMutex> lock(mutex_);
  for (uint32_t i = 0; i < module_.areas.size(); ++i)
    std::copy_n(memory_.area(i), module_.areas[i].size, copy.areas[i]);
  for (uint32_t i = 0; i < module_.areas.size(); ++i)
    if (!copy.taken[i].empty()) memcpy(copy.taken[i].data(), memory_.area(i), module_.areas[i].size);
  for (size_t i = 0; i < globals_.size(); ++i) {
    const uint32_t block = globals_[i].block;
    memcpy(copy.blocks[block], memory_.block(block), module_.blocks[block].size);
    memcpy(copy.before[i].data(), memory_.block(block), module_.blocks[block].size);
  }
  context.areas = copy.areas.data();
  context.blocks = copy.blocks.data();
}

void Exchange::give(uint32_t task, rung_context& context) {
  if (copies_.empty()) return;
  const Copy& copy = copies_[task];
  const rung_task& row = module_.tasks[task];
  const std::lock_guard<PriorityMutex> lock(mutex_);
  for (uint32_t i = 0; i < row.write_count; ++i) {
    const rung_write& part = module_.writes[row.first_write + i];
    if (copy.taken[part.area].empty()) copyBits(memory_.area(part.area), copy.areas[part.area], part);
  }
  giveShared(copy);
  giveGlobals(copy);
  drop(context);
}

// The bits that the task has changed, whatever other tasks did meanwhile. Most chunks of a large area have none.
void Exchange::giveShared(const Copy& copy) {
  for (uint32_t i = 0; i < module_.areas.size(); ++i) {
    if (copy.taken[i].empty()) continue;
    uint8_t* const common = memory_.area(i);
    const uint8_t* const mine = copy.areas[i];
    const auto* const before = reinterpret_cast<const uint8_t*>(copy.taken[i].data());
    const uint32_t size = module_.areas[i].size;
    for (uint32_t begin = 0; begin < size; begin += kScanned) {
      const uint32_t end = std::min(begin + kScanned, size);
      if (memcmp(mine + begin, before + begin, end - begin) == 0) continue;
      for (uint32_t at = begin; at < end; ++at) {
        const auto changed = static_cast<uint8_t>(mine[at] ^ before[at]);
        common[at] = static_cast<uint8_t>((common[at] & ~changed) | (mine[at] & changed));
      }
    }
  }
}

void Exchange::drop(rung_context& context) const {
  context.areas = memory_.common().areas;
  context.blocks = memory_.common().blocks;
}

void Exchange::makeSafe(uint32_t task) {
  const rung_task& row = module_.tasks[task];
  std::vector<std::vector<uint8_t>> values;
  memory_.safeOutputs(values);
  const std::lock_guard<PriorityMutex> lock(mutex_);
  for (uint32_t i = 0; i < row.write_count; ++i) {
    const rung_write& part = module_.writes[row.first_write + i];
    if (module_.areas[part.area].owner == RUNG_AREA_OUTPUT)
      copyBits(memory_.area(part.area), values[part.area].data(), part);
  }
}

// A variable counts as written when its value is another one than at the start.
void Exchange::giveGlobals(const Copy& copy) {
  for (size_t i = 0; i < globals_.size(); ++i) {
    const Globals& globals = globals_[i];
    const auto* const now = static_cast<const uint8_t*>(copy.blocks[globals.block]);
    const auto* const before = reinterpret_cast<const uint8_t*>(copy.before[i].data());
    uint8_t* const common = memory_.block(globals.block);
    for (const Run& run : globals.runs) {
      const uint32_t end = run.offset + run.size * run.count;
      if (memcmp(now + run.offset, before + run.offset, end - run.offset) == 0) continue;
      for (uint32_t at = run.offset; at < end; at += run.size)
        if (memcmp(now + at, before + at, run.size) != 0) memcpy(common + at, now + at, run.size);
    }
  }
}

}  // namespace rung::host
