// SPDX-License-Identifier: Apache-2.0
// Tasks and their activations: see tasks.h.
#include "tasks.h"

#include <algorithm>
#include <cstdio>

#include "crashes.h"

namespace rung::host {
namespace {

std::string microseconds(int64_t ns) {
  char text[32];
  snprintf(text, sizeof text, ns % 1000 == 0 ? "%.0f" : "%.1f", static_cast<double>(ns) / 1000);
  return text;
}

// The time that all but one of a thousand are below.
int64_t almostAll(const Histogram& histogram, int64_t latest_ns) {
  uint64_t total = 0, seen = 0;
  for (const uint32_t count : histogram.counts) total += count;
  for (uint32_t i = 0; i + 1 < Histogram::kBuckets; ++i) {
    seen += histogram.counts[i];
    if (seen * 1000 >= total * 999) return (i + 1) * int64_t{1000};
  }
  return latest_ns;
}

}  // namespace

bool readBool(const Variable& variable) {
  const uint8_t* const at = variable.address();
  if (at == nullptr) return false;
  const uint8_t value = __atomic_load_n(at, __ATOMIC_RELAXED);
  return variable.bit == 255 ? value != 0 : (value >> variable.bit & 1) != 0;
}

Tasks::Tasks(const Symbols& symbols, Memory& memory, Drivers& drivers, Forces& forces, int64_t interval_ns)
    : symbols_(symbols),
      memory_(memory),
      drivers_(drivers),
      forces_(forces),
      exchange_(symbols, memory),
      scope_(symbols, exchange_),
      tasks_(symbols.module().tasks.size()),
      states_(symbols.module().tasks.size()) {
  const LoadedModule& module = symbols.module();
  for (uint32_t i = 0; i < module.tasks.size(); ++i) {
    const rung_task& row = module.tasks[i];
    tasks_[i].row = &row;
    tasks_[i].index = i;
    tasks_[i].interval_ns = row.interval_ns;
    if (row.kind != RUNG_CYCLIC) continue;
    if (row.interval_ns <= 0) tasks_[i].interval_ns = interval_ns;
    if (fastest_ == RUNG_NONE || tasks_[i].interval_ns < tasks_[fastest_].interval_ns) fastest_ = i;
  }
  row_ns_ = fastest_ == RUNG_NONE ? interval_ns : tasks_[fastest_].interval_ns;
}

std::string Tasks::nameOf(const Task& task) const {
  const char* const name = symbols_.text(task.row->name);
  return *name != 0 ? name : "(default)";
}

bool Tasks::prepare(std::string& error) {
  memory_.context().task_states = states_.data();
  for (Task& task : tasks_) {
    if (task.row->kind != RUNG_EVENT && task.row->kind != RUNG_STATUS) continue;
    const std::string name = symbols_.text(task.row->name);
    if (!symbols_.find(symbols_.text(task.row->trigger), task.trigger, error)) {
      error = "task `" + name + "`: " + error;
      return false;
    }
    if (task.trigger.type->kind != RUNG_BOOL) {
      error = "task `" + name + "`: the trigger `" + task.trigger.path + "` is not a BOOL";
      return false;
    }
  }
  return drivers_.bind(fastest_, error);
}

// The caller holds the lock: the program and the user may read the statistics meanwhile.
void Tasks::noteStart(Task& task, int64_t start_ns, int64_t late_ns) {
  rung_task_state& state = states_[task.index];
  if (!task.is_first && task.interval_ns > 0) {
    const int64_t off = start_ns - state.last_start_ns - task.interval_ns;
    state.earliest_ns = std::min(state.earliest_ns, off);
    state.latest_ns = std::max(state.latest_ns, off);
  }
  task.is_first = false;
  state.last_start_ns = start_ns;
  task.lateness.add(late_ns);
  task.latest_start = std::max(task.latest_start, late_ns);
}

void Tasks::noteEnd(Task& task, int64_t took_ns) {
  rung_task_state& state = states_[task.index];
  ++state.activations;
  state.last_ns = took_ns;
  state.shortest_ns = state.activations == 1 ? took_ns : std::min(state.shortest_ns, took_ns);
  state.longest_ns = std::max(state.longest_ns, took_ns);
  state.total_ns += took_ns;
}

uint8_t Tasks::begin(Task& task, rung_context& context, int64_t now_ns, int64_t late_ns) {
  {
    const std::lock_guard<Exchange> lock(exchange_);
    noteStart(task, now_ns + late_ns, late_ns);
    noteLost(drivers_.read(task.index, now_ns));
    exchangeServed();
    applyForces();
  }
  exchange_.take(task.index, context);
  context.now_ns = now_ns;
  context.entry = rung_task_at(context.module, task.index);
  context.task = task.index + 1;
  context.activation = ++task.activation;
  const uint8_t fault = guarded(&context, task.row->run);
  if (fault != RUNG_FAULT_NONE) exchange_.drop(context);
  if (fault == RUNG_FAULT_NONE && !forces_.isEmpty()) forceAfterCode(context);
  return fault;
}

void Tasks::forceAfterCode(const rung_context& context) {
  const std::lock_guard<Exchange> lock(exchange_);
  forces_.apply(context);
}

// An output that a fault has made safe: a task that has stopped may write it.
bool Tasks::isSafeOutput(const rung_variable& variable) const {
  const LoadedModule& module = symbols_.module();
  const auto* const at = static_cast<const uint8_t*>(rung_address(&memory_.common(), &variable));
  const auto isPartOf = [&](const rung_write& part) {
    const uint8_t* const begin = memory_.area(part.area) + part.offset;
    const bool overlaps = at < begin + part.size && begin < at + variable.type->size;
    return overlaps && (variable.bit == 255 || (part.mask >> variable.bit & 1) != 0);
  };
  for (const Task& task : tasks_) {
    for (uint32_t i = 0; at != nullptr && task.stopped && i < task.row->write_count; ++i) {
      const rung_write& part = module.writes[task.row->first_write + i];
      if (module.areas[part.area].owner == RUNG_AREA_OUTPUT && isPartOf(part)) return true;
    }
  }
  return false;
}

void Tasks::noteForces() {
  const std::lock_guard<Exchange> lock(exchange_);
  forces_.hold([this](const rung_variable& variable) { return isSafeOutput(variable); });
}

bool Tasks::end(Task& task, rung_context& context, int64_t now_ns, int64_t took_ns) {
  // Longer than the watchdog's time as often in a row as its sensitivity says, or once by the product of both.
  const int64_t watchdog = task.row->watchdog_ns;
  task.too_long = watchdog > 0 && took_ns > watchdog ? task.too_long + 1 : 0;
  const bool goes_on =
      watchdog <= 0 || (task.too_long < std::max(1u, task.row->sensitivity) && took_ns <= limitOf(task));
  if (goes_on)
    exchange_.give(task.index, context);
  else
    exchange_.drop(context);
  const std::lock_guard<Exchange> lock(exchange_);
  noteEnd(task, took_ns);
  if (!goes_on) return false;
  applyForces();
  scope_.sample(task.index, memory_.common(), states_[task.index].last_start_ns);
  exchangeServed();
  noteLost(drivers_.write(task.index, now_ns));
  return true;
}

void Tasks::stopOne(Task& task, const rung_context& context) {
  task.stopped = true;
  task.fault = context.fault;
  task.caller_count = context.caller_count;
  task.callers.assign(context.callers, context.callers + std::min<uint32_t>(context.caller_count, RUNG_CALLERS));
  noteForces();
  exchange_.makeSafe(task.index);
  const std::lock_guard<Exchange> lock(exchange_);
  drivers_.write(task.index, states_[task.index].last_start_ns);
}

void Tasks::switchOn() {
  for (Task& task : tasks_) {
    Task fresh;
    fresh.row = task.row;
    fresh.index = task.index;
    fresh.interval_ns = task.interval_ns;
    fresh.trigger = task.trigger;
    task = fresh;
  }
  std::fill(states_.begin(), states_.end(), rung_task_state{});
}

const Task* Tasks::find(const std::string& name) const {
  const auto found = std::find_if(tasks_.begin(), tasks_.end(), [&](const Task& task) { return nameOf(task) == name; });
  return found == tasks_.end() ? nullptr : &*found;
}

void Tasks::goOnFrom(Tasks& before) {
  const std::lock_guard<Exchange> lock(before.exchange_);  // starts that were dropped may be counted meanwhile
  for (Task& task : tasks_) {
    const Task* const was = before.find(nameOf(task));
    if (was == nullptr) continue;
    states_[task.index] = before.states_[was->index];
    task.activation = was->activation;
    task.too_long = was->too_long;
    task.is_first = was->is_first || was->interval_ns != task.interval_ns;
    task.lateness = was->lateness;
    task.latest_start = was->latest_start;
  }
  served_ = before.served_;
}

void Tasks::restart() {
  for (Task& task : tasks_) {
    task.stopped = false;
    task.activation = task.too_long = 0;
  }
  noteForces();
}

void Tasks::makeOutputsSafe(int64_t now_ns) {
  const std::lock_guard<Exchange> lock(exchange_);
  memory_.makeOutputsSafe();
  drivers_.writeAll(now_ns);
}

void Tasks::restoreOutputs() {
  for (Task& task : tasks_) task.is_first = true;
  const std::lock_guard<Exchange> lock(exchange_);
  memory_.restoreOutputs();
}

void Tasks::transfer(StateArchive& archive) {
  for (Task& task : tasks_) {
    archive.values(task.activation, task.too_long, task.is_first, task.stopped, task.fault, task.caller_count);
    archive.list(task.callers);
    archive.values(task.lateness, task.latest_start);
  }
  for (rung_task_state& state : states_) archive.value(state);
  archive.text(lost_driver_);
  has_lost_driver_.store(!lost_driver_.empty());
  exchange_.transfer(archive);
}

int64_t Tasks::limitOf(const Task& task) { return task.row->watchdog_ns * std::max<int64_t>(1, task.row->sensitivity); }

std::string Tasks::statistics(int64_t elapsed_ns) {
  const std::lock_guard<Exchange> lock(exchange_);
  std::string text;
  for (const Task& task : tasks_) {
    const rung_task_state& state = states_[task.index];
    text += "task " + nameOf(task) + ": " + std::to_string(state.activations) + " activations, " +
            std::to_string(state.overruns) + " overruns";
    if (state.activations > 0) {
      text += ", ran " + microseconds(state.shortest_ns) + '/' + microseconds(state.total_ns / state.activations) +
              '/' + microseconds(state.longest_ns) + " us (min/average/max)";
      if (task.row->kind == RUNG_CYCLIC)
        text += ", jitter " + microseconds(state.earliest_ns) + ".." + microseconds(state.latest_ns) +
                " us, started up to " + microseconds(task.latest_start) + " us late";
      if (task.row->kind == RUNG_CYCLIC && state.activations >= 1000)
        text += ", 99.9 % below " + microseconds(almostAll(task.lateness, task.latest_start)) + " us";
      if (elapsed_ns > 0) {
        char load[32];
        snprintf(load, sizeof load, ", load %.1f %%",
                 100.0 * static_cast<double>(state.total_ns) / static_cast<double>(elapsed_ns));
        text += load;
      }
    }
    text += '\n';
  }
  return text;
}

}  // namespace rung::host
