// SPDX-License-Identifier: Apache-2.0
// Warns of a task that runs a block which needs another one. What a block needs is written at its declaration:
// {attribute 'task_interval' := '1, 2, 4'}, a cyclic task of one of these intervals in ms (TM/TP manual 9.1);
// {attribute 'task_priority' := '16'}, a task of this priority or a lower one, a greater number (TM/TP manual 6.17.2);
// {attribute 'task_priorities' := '15 to 30'}, not the task of priority 0, if there are others (TM/TP table 1-3,
// AX 6.5).
//   passes  TASK t(INTERVAL := T#2ms) with a program that calls ENC_Counter
//   warns   TASK t(INTERVAL := T#10ms) with that program                       W1220
// Called once, when all bodies are checked. Linear in POUs and calls for each task.
#include "sema/checks/rules.h"

#include <algorithm>
#include <charconv>

#include "sema/declarations/collect.h"
#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// What the declarations of POUs ask for; empty for most.
struct Need {
  PouId pou;
  std::string_view intervals;  // ms, separated by commas
  uint32_t priority = 0;
  std::string_view priorities;  // words for the message
};

std::string_view attributeValue(Context& context, const Pou& pou, NameId attribute) {
  const DeclHeader& header = context.tree().decl(pou.decl);
  const Pragma* const pragma = header.pragmas.empty() ? nullptr : findPragma(context, header, attribute);
  return pragma == nullptr ? std::string_view() : context.tree().string(pragma->value);
}

bool contains(std::string_view intervals, int64_t interval_ns) {
  for (const char* at = intervals.data(); at < intervals.data() + intervals.size();) {
    int64_t ms = 0;
    const auto [end, error] = std::from_chars(at, intervals.data() + intervals.size(), ms);
    if (error == std::errc() && ms * 1'000'000 == interval_ns) return true;
    at = end == at ? at + 1 : end;
  }
  return false;
}

std::vector<Need> needsOf(Context& context) {
  const NameId interval = context.names().key(context.names().intern("task_interval"));
  const NameId priority = context.names().key(context.names().intern("task_priority"));
  const NameId priorities = context.names().key(context.names().intern("task_priorities"));
  std::vector<Need> needs;
  for (uint32_t i = 0; i < context.project.pous.size(); ++i) {
    const Pou& pou = context.symbols.pou(PouId{i});
    if (!pou.library || !pou.decl) continue;
    Need need{PouId{i}, attributeValue(context, pou, interval), 0, attributeValue(context, pou, priorities)};
    const std::string_view least = attributeValue(context, pou, priority);
    std::from_chars(least.data(), least.data() + least.size(), need.priority);
    if (!need.intervals.empty() || need.priority > 0 || !need.priorities.empty()) needs.push_back(need);
  }
  return needs;
}

// The POUs that the programs of a task reach.
std::vector<bool> reachedBy(const Project& project, uint32_t task, const std::vector<uint32_t>& first) {
  std::vector<bool> seen(project.pous.size());
  std::vector<uint32_t> open;
  for (const ProgramInstance& instance : project.instances)
    if (instance.task == task && instance.program) open.push_back(instance.program.index);
  while (!open.empty()) {
    const uint32_t pou = open.back();
    open.pop_back();
    if (seen[pou]) continue;
    seen[pou] = true;
    for (uint32_t e = first[pou]; e < first[pou + 1]; ++e) open.push_back(project.call_edges[e].callee.index);
  }
  return seen;
}

bool isOneOfSeveral(const Project& project, const Task& task) {
  return std::any_of(project.tasks.begin(), project.tasks.end(), [&](const Task& other) {
    return &other != &task && other.loc && other.resource == task.resource;
  });
}

}  // namespace

void checkTaskNeeds(Context& context) {
  const Project& project = context.project;
  if (project.tasks.empty()) return;
  const std::vector<Need> needs = needsOf(context);
  if (needs.empty()) return;
  std::vector<uint32_t> first(project.pous.size() + 1, 0);
  for (const auto& edge : project.call_edges) ++first[edge.caller.index + 1];
  for (size_t i = 0; i < project.pous.size(); ++i) first[i + 1] += first[i];
  for (uint32_t t = 0; t < project.tasks.size(); ++t) {
    const Task& task = project.tasks[t];
    if (!task.loc) continue;  // no task of the user
    const std::vector<bool> reached = reachedBy(project, t + 1, first);
    // With one task the priority has no meaning (TM/TP 1.5); without PRIORITY 0 was not asked for.
    const bool is_first = task.priority == 0 && task.priority_loc && isOneOfSeveral(project, task);
    bool interval_reported = false, priority_reported = false, first_reported = false;
    for (const Need& need : needs) {
      if (!reached[need.pou.index]) continue;
      const std::string_view name = string(context, context.symbols.pou(need.pou).name);
      if (!need.intervals.empty() && !interval_reported && task.kind == TaskKind::Cyclic && task.interval_ns > 0 &&
          !contains(need.intervals, task.interval_ns)) {
        interval_reported = true;
        context.report(diag::BlockNeedsInterval, task.interval_loc ? task.interval_loc : task.loc,
                       {name, std::string(need.intervals), types::durationText(task.interval_ns)});
      }
      if (need.priority > task.priority && !priority_reported) {
        priority_reported = true;
        context.report(diag::BlockNeedsPriority, task.priority_loc ? task.priority_loc : task.loc,
                       {name, std::to_string(need.priority), std::to_string(task.priority)});
      }
      if (!need.priorities.empty() && is_first && !first_reported) {
        first_reported = true;
        context.report(diag::BlockInFirstTask, task.priority_loc, {name, std::string(need.priorities)});
      }
    }
  }
}

}  // namespace rung::sema
