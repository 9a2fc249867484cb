// The memory of a running module: blocks, areas and the context. In: a module. Out: memory set to its initial
// values. One per run; a test run resets it before each test.
#pragma once

#include <memory>
#include <vector>

#include "rung/module.h"

namespace rung::host {

class Memory {
 public:
  explicit Memory(const rung_module& module);
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  rung_context& context() { return context_; }
  uint8_t* block(uint32_t index) const { return blocks_[index]; }
  uint8_t* area(uint32_t index) const { return areas_[index]; }
  // Zeroes everything and runs the module's init; RUNG_FAULT_NONE or the fault that it raised.
  uint8_t reset();
  // Ends all objects (FB_Exit); returns the same.
  uint8_t end();
  // Sets outputs to their safe values, after a fault.
  void makeOutputsSafe();
  // The safe values of an output area: as many bytes as it has.
  void safeOutputs(uint32_t area, uint8_t* values) const;

 private:
  const rung_module& module_;
  rung_context context_{};
  std::vector<std::unique_ptr<uint8_t[]>> storage_;
  std::vector<uint8_t*> blocks_;
  std::vector<void*> block_pointers_;
  std::vector<uint8_t*> areas_;
};

// The reason why a module cannot run here (another ABI or pointer size), or nullptr.
const char* refusal(const rung_module& module);

}  // namespace rung::host
