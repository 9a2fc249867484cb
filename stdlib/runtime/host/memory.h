// SPDX-License-Identifier: Apache-2.0
// The memory of a running module: blocks, areas and the context. In: a module. Out: memory set to its initial
// values. One per run; a test run resets it before each test.
#pragma once

#include <memory>
#include <vector>

#include "loaded_module.h"
#include "state_archive.h"

namespace rung::host {

class Memory {
 public:
  explicit Memory(const LoadedModule& module);
  // In the place of another version's: shares the blocks that stay (`kept`: by block its number there, or RUNG_NONE)
  // and the areas that are as large. All else is 0.
  Memory(const LoadedModule& module, const Memory& before, const std::vector<uint32_t>& kept);
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  rung_context& context() { return context_; }
  const rung_context& context() const { return context_; }
  // The memory that all tasks share, whichever copies the context of an activation has.
  const rung_context& common() const { return common_; }
  uint8_t* block(uint32_t index) const { return block_parts_[index].begin; }
  uint8_t* area(uint32_t index) const { return areas_[index]; }
  // Zeroes everything and runs the module's init; RUNG_FAULT_NONE or the fault that it raised. `keeps_inputs`: the
  // input areas hold what devices gave.
  uint8_t reset(bool keeps_inputs = false);
  // Ends all objects (FB_Exit); returns the same.
  uint8_t end();
  // Sets outputs to their safe values when the program stops; restoreOutputs gives them back, where it goes on.
  void makeOutputsSafe();
  void restoreOutputs();
  // All blocks and areas, and what the context says of the last activation; about so many bytes.
  void transfer(StateArchive& archive);
  size_t bytes() const;
  // Areas with the safe values of all outputs.
  void safeOutputs(std::vector<std::vector<uint8_t>>& areas) const;

 private:
  // Memory of one block or area: two versions of a program may share it.
  struct Part {
    std::shared_ptr<uint8_t[]> storage;
    uint8_t* begin = nullptr;
  };
  static Part allocate(size_t size, size_t align);
  void describe();
  uint8_t run(void (*function)(rung_context*));  // of the module; null: it has none

  const LoadedModule& module_;
  rung_context context_{}, common_{};
  std::vector<Part> block_parts_, area_parts_;
  std::vector<void*> blocks_;
  std::vector<uint8_t*> areas_;
  std::vector<std::vector<uint8_t>> kept_outputs_;  // by area, while outputs have their safe values; else empty
};

// The reason why a module cannot run here (another ABI or pointer size), or nullptr.
const char* refusal(const rung_module& module);

}  // namespace rung::host
