// Tasks in virtual time: see schedule.h.
#include "schedule.h"

#include <algorithm>

#include "crashes.h"

namespace rung::host {

bool readBool(const Variable& variable) {
  const uint8_t* const at = variable.address();
  if (at == nullptr) return false;
  return variable.bit == 255 ? *at != 0 : (*at >> variable.bit & 1) != 0;
}

Schedule::Schedule(const Symbols& symbols, int64_t interval_ns) : symbols_(symbols), row_ns_(0) {
  const rung_module& module = symbols.module();
  for (uint32_t i = 0; i < module.task_count; ++i) {
    const rung_task& task = module.tasks[i];
    Item item{&task, task.interval_ns, 0, false, 0, {}};
    if (task.kind == RUNG_CYCLIC) {
      if (task.interval_ns <= 0) item.interval_ns = interval_ns;
    }
    const bool is_periodic = task.kind == RUNG_CYCLIC || (task.kind == RUNG_EVENT && task.interval_ns > 0);
    if (is_periodic) row_ns_ = row_ns_ == 0 ? item.interval_ns : std::min(row_ns_, item.interval_ns);
    items_.push_back(std::move(item));
  }
  if (row_ns_ == 0) row_ns_ = interval_ns;
}

bool Schedule::prepare(std::string& error) {
  for (Item& item : items_) {
    if (item.task->kind != RUNG_EVENT && item.task->kind != RUNG_STATUS) continue;
    const std::string name = symbols_.text(item.task->name);
    if (!symbols_.find(symbols_.text(item.task->trigger), item.trigger, error)) {
      error = "task `" + name + "`: " + error;
      return false;
    }
    if (item.trigger.type->kind != RUNG_BOOL) {
      error = "task `" + name + "`: the trigger `" + item.trigger.path + "` is not a BOOL";
      return false;
    }
  }
  return true;
}

uint8_t Schedule::run(int64_t row, rung_context& context) {
  const int64_t begin = row * row_ns_, end = begin + row_ns_;
  due_.clear();
  for (uint32_t i = 0; i < items_.size(); ++i) {
    Item& item = items_[i];
    switch (static_cast<rung_task_kind>(item.task->kind)) {
      case RUNG_CYCLIC:
        // The period is at least a row, so at most once.
        if (item.next_ns >= end) break;
        due_.push_back({item.next_ns, item.task->priority, i});
        item.next_ns += item.interval_ns;
        break;
      case RUNG_FREEWHEELING: due_.push_back({begin, item.task->priority, i}); break;
      case RUNG_EVENT: {
        const bool is_true = readBool(item.trigger);
        if (is_true && !item.was_true) due_.push_back({begin, item.task->priority, i});
        item.was_true = is_true;
        // With INTERVAL also periodic while SINGLE is 0 (IEC 61131-3 ed. 3, 6.8.2). The grid goes on while it is 1.
        if (item.interval_ns <= 0 || item.next_ns >= end) break;
        if (!is_true) due_.push_back({item.next_ns, item.task->priority, i});
        item.next_ns += item.interval_ns;
        break;
      }
      case RUNG_STATUS:
        if (readBool(item.trigger)) due_.push_back({begin, item.task->priority, i});
        break;
      case RUNG_EXTERNAL: break;  // virtual time has no external events
    }
  }
  if (due_.size() > 1)
    std::stable_sort(due_.begin(), due_.end(), [](const Activation& a, const Activation& b) {
      return a.time_ns != b.time_ns ? a.time_ns < b.time_ns : a.priority < b.priority;
    });
  for (const Activation& activation : due_) {
    context.now_ns = activation.time_ns;
    Item& item = items_[activation.item];
    context.entry = item.task;
    context.task = activation.item + 1;
    context.activation = ++item.activations;
    const uint8_t fault = guarded(&context, item.task->run);
    if (fault != RUNG_FAULT_NONE) return fault;
  }
  return RUNG_FAULT_NONE;
}

}  // namespace rung::host
