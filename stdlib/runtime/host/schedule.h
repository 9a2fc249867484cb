// Virtual time: which tasks run in a row, in which order, and at which time. A row is one period of the fastest cyclic
// task. In: the tasks of a module. Out: each activation run; faults stop the row.
#pragma once

#include <string>
#include <vector>

#include "symbols.h"

namespace rung::host {

class Schedule {
 public:
  // `interval_ns` is the period of cyclic tasks without one, and of a row when there is no cyclic task.
  Schedule(const Symbols& symbols, int64_t interval_ns);
  // False: a trigger is not a BOOL; `error` has the message.
  bool prepare(std::string& error);
  int64_t rowNs() const { return row_ns_; }
  // Runs all activations of row k. Returns RUNG_FAULT_NONE, or the fault that stopped it.
  uint8_t run(int64_t row, rung_context& context);

  struct Item {
    const rung_task* task;
    int64_t interval_ns;
    int64_t next_ns = 0;    // cyclic
    bool was_true = false;  // event: at the last sample
    uint32_t activations = 0;
    Variable trigger;
  };
  const std::vector<Item>& items() const { return items_; }

 private:
  struct Activation {
    int64_t time_ns;
    uint32_t priority, item;
  };
  const Symbols& symbols_;
  int64_t row_ns_;
  std::vector<Item> items_;
  std::vector<Activation> due_;
};

bool readBool(const Variable& variable);

}  // namespace rung::host
