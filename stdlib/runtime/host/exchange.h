// SPDX-License-Identifier: Apache-2.0
// Gives each task its view of the memory that tasks share. A task takes the image when its activation begins and gives
// what it wrote when it ends, all at once: inputs do not change under it, and outputs leave together (TM/TP manual 1.3,
// AX 6.3). With RUNG_ALIGNED_GLOBALS, or with several resources, it does the same with global variables (TM/TP 1.5,
// AX 6.5); else it shares them directly. In: the module's tables and memory. Called by tasks.cpp, from any thread.
#pragma once

#include <vector>

#include "priority_mutex.h"
#include "symbols.h"

namespace rung::host {

class Exchange {
 public:
  Exchange(const Symbols& symbols, Memory& memory);

  // The context works on the task's own memory from now on. A program with one task that takes no
  // simulated time has no copies.
  void take(uint32_t task, rung_context& context);
  // Publishes what the task wrote.
  void give(uint32_t task, rung_context& context);
  // Forgets what the task wrote, after a fault.
  void drop(rung_context& context) const;
  // Sets what the task may write of outputs to the safe values.
  void makeSafe(uint32_t task);

  // The copies of activations that have not ended.
  void transfer(StateArchive& archive);

  // For std::lock_guard: the common image and globals do not change while one holds it.
  void lock() { mutex_.lock(); }
  void unlock() { mutex_.unlock(); }

 private:
  // Scalars of one size, one after the other in a block.
  struct Run {
    uint32_t offset, size, count;
  };
  struct Globals {
    uint32_t block;
    std::vector<Run> runs;
  };
  struct Copy {
    std::vector<std::vector<uint64_t>> storage;
    std::vector<uint8_t*> areas;
    std::vector<std::vector<uint64_t>> taken;  // shared areas as they were taken; others are empty
    std::vector<void*> blocks;
    std::vector<std::vector<uint64_t>> before;  // per row of globals_: as it was taken
  };
  void findGlobals(const Symbols& symbols);
  void addRun(const Run& run);
  void closeGlobals();
  void giveShared(const Copy& copy);
  void giveGlobals(const Copy& copy);

  const LoadedModule& module_;
  Memory& memory_;
  std::vector<Globals> globals_;
  std::vector<Copy> copies_;  // by task; empty: all work on the common memory
  PriorityMutex mutex_;       // a low task that publishes is not interrupted for long
};

}  // namespace rung::host
