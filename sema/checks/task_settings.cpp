// SPDX-License-Identifier: Apache-2.0
// Warns of settings of tasks that do not fit each other, and forbids more tasks than a resource may have. Tasks of one
// resource share a CPU, so only these are compared.
//   fails   the 101st TASK t(INTERVAL := …)                                        E1141
//   warns   TASK a(…, PRIORITY := 1); TASK b(…, PRIORITY := 1);                    W1142
// Linear in tasks but for the periods, which are at most 100 a resource.
#include "sema/checks/rules.h"

#include <algorithm>
#include <vector>

#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

using Tasks = std::vector<const Task*>;

// Forbids more than 100 tasks of one kind in a resource; status and external tasks count as event tasks. TM/TP
// manual 1.2.
//   fails   the 101st TASK t(INTERVAL := …)             E1141
void checkTaskCount(Context& context, const Tasks& tasks) {
  constexpr uint32_t kMost = 100;
  static constexpr const char* kWords[] = {"cyclic", "freewheeling", "event, status and external"};
  uint32_t counts[3] = {};
  for (const Task* task : tasks) {
    const size_t kind = task->kind == TaskKind::Cyclic ? 0 : task->kind == TaskKind::Freewheeling ? 1 : 2;
    if (++counts[kind] == kMost + 1)
      context.report(diag::TooManyTasks, task->loc, {std::to_string(kMost), kWords[kind]});
  }
}

// Warns of two tasks with one priority, when at least one of them asks for it: which runs first is then not defined.
// TM/TP manual 1.5; in the standard the one that waits longer runs first (ed. 3, 6.8.2).
//   passes  TASK a(…, PRIORITY := 1); TASK b(…, PRIORITY := 2);
//   fails   TASK a(…, PRIORITY := 1); TASK b(…, PRIORITY := 1);    W1142
void checkEqualPriorities(Context& context, const Tasks& tasks) {
  constexpr uint32_t kPriorities = 32;
  const Task* first[kPriorities] = {};
  bool reported[kPriorities] = {};
  for (const Task* task : tasks) {
    if (task->priority >= kPriorities) continue;
    const Task*& other = first[task->priority];
    if (other == nullptr) {
      other = task;
    } else if (!reported[task->priority] && (task->priority_loc || other->priority_loc)) {
      const Loc loc = task->priority_loc ? task->priority_loc : task->loc;
      context
          .report(diag::EqualPriorities, loc,
                  {string(context, task->name), std::to_string(task->priority), string(context, other->name)})
          .declaredHere(other->loc);
      reported[task->priority] = true;
    }
  }
}

// Warns of a period that is not a multiple of the shorter ones: such tasks drift against each other, and globals that
// they exchange are never aligned. TM/TP manual 1.5.
//   passes  T#4ms and T#100ms
//   fails   T#4ms and T#10ms                            W1143
void checkPeriods(Context& context, const Tasks& tasks) {
  Tasks cyclic;
  for (const Task* task : tasks)
    if (task->kind == TaskKind::Cyclic && task->interval_ns > 0) cyclic.push_back(task);
  std::stable_sort(cyclic.begin(), cyclic.end(),
                   [](const Task* a, const Task* b) { return a->interval_ns < b->interval_ns; });
  for (size_t i = 1; i < cyclic.size(); ++i) {
    const auto other =
        std::find_if(cyclic.begin(), cyclic.begin() + static_cast<ptrdiff_t>(i),
                     [&](const Task* shorter) { return cyclic[i]->interval_ns % shorter->interval_ns != 0; });
    if (*other == cyclic[i]) continue;
    context
        .report(diag::PeriodNotMultiple, cyclic[i]->interval_loc ? cyclic[i]->interval_loc : cyclic[i]->loc,
                {types::durationText(cyclic[i]->interval_ns), types::durationText((*other)->interval_ns),
                 string(context, (*other)->name)})
        .declaredHere((*other)->loc);
  }
}

// Warns of a watchdog that is not longer than the period: it would stop a task that is only late. TM/TP manual 1.9.
//   passes  INTERVAL := T#10ms, WATCHDOG := T#20ms
//   fails   INTERVAL := T#10ms, WATCHDOG := T#10ms      W1144
void checkWatchdogs(Context& context, const Tasks& tasks) {
  for (const Task* task : tasks) {
    if (task->kind != TaskKind::Cyclic || task->watchdog_ns == 0 || task->watchdog_ns > task->interval_ns) continue;
    context.report(diag::WatchdogTooShort, task->watchdog_loc,
                   {types::durationText(task->watchdog_ns), types::durationText(task->interval_ns)});
  }
}

}  // namespace

void checkTaskSettings(Context& context) {
  std::vector<std::pair<NameId, Tasks>> resources;
  for (const Task& task : context.project.tasks) {
    if (!task.loc) continue;  // no task of the user
    const NameId resource = task.resource ? context.names().key(task.resource) : NameId{};
    auto at = std::find_if(resources.begin(), resources.end(), [&](const auto& one) { return one.first == resource; });
    if (at == resources.end()) at = resources.insert(at, {resource, {}});
    at->second.push_back(&task);
  }
  for (const auto& [resource, tasks] : resources) {
    checkTaskCount(context, tasks);
    checkWatchdogs(context, tasks);
    if (context.profile().warns_of_equal_priorities) checkEqualPriorities(context, tasks);
    if (context.profile().warns_of_odd_periods) checkPeriods(context, tasks);
  }
}

}  // namespace rung::sema
