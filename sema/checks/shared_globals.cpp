// SPDX-License-Identifier: Apache-2.0
// Warns of a variable outside of the program that the programs of two tasks write: one task may interrupt the other
// between its read and its write. Globals are shared without a copy per task (docs/language.md "Tasks").
//   passes  one task writes `level`, the other reads it
//   fails   both tasks have `count := count + 1;`                                                    W0829
//   fails   both tasks have `move(Axis := X);`                                                       W1530
// Called once, when all bodies are checked. Linear in POUs and calls for each task.
#include "sema/checks/rules.h"

#include "sema/declarations/objects.h"
#include "sema/declarations/uncopied.h"
#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

// The variable that code means when this resource runs it.
static VarId ofResource(const Context& context, VarId global, NameId resource) {
  for (const ResourceGlobals& globals : context.project.resource_globals)
    if (resource && globals.all.front().var == global) return globals.of(context.names().key(resource));
  return global;
}

// An instance that a task serves, by {before_task} and {after_task}: an axis.
static bool isServed(Context& context, TypeId type) {
  while (context.types().kind(type) == types::TypeKind::Array)
    type = context.types().info(context.types().resolve(type)).base;
  if (context.types().kind(type) != types::TypeKind::Record) return false;
  for (PouId block = pouOf(context, type); block; block = context.symbols.pou(block).base)
    for (const PouId member : context.symbols.pou(block).members) {
      const Pou::Pragmas& pragmas = context.symbols.pou(member).pragmas;
      if (pragmas.before_task || pragmas.after_task) return true;
    }
  return false;
}

// Of two tasks, the one that serves an instance which both name: the one with the higher priority.
static const Task& serving(const Task& first, const Task& second) {
  return second.priority < first.priority ? second : first;
}

void checkSharedGlobals(Context& context) {
  const Project& project = context.project;
  if (project.tasks.size() < 2) return;
  const auto& edges = project.call_edges;
  const size_t count = project.pous.size();
  std::vector<uint32_t> first(count + 1, 0);
  for (const auto& edge : edges) ++first[edge.caller.index + 1];
  for (size_t i = 0; i < count; ++i) first[i + 1] += first[i];

  std::vector<uint32_t> writer(project.vars.size(), 0);  // the task, from 1; reported: ~0
  std::vector<uint32_t> seen(count, 0);
  std::vector<uint32_t> open;
  for (uint32_t task = 1; task <= project.tasks.size(); ++task) {
    for (const ProgramInstance& instance : project.instances) {
      if (instance.task == task && instance.program) open.push_back(instance.program.index);
    }
    while (!open.empty()) {
      const uint32_t pou = open.back();
      open.pop_back();
      if (seen[pou] == task) continue;
      seen[pou] = task;
      for (uint32_t e = first[pou]; e < first[pou + 1]; ++e) open.push_back(edges[e].callee.index);
    }
    for (const auto& write : project.global_writes) {
      if (seen[write.pou.index] != task) continue;
      const VarId written = ofResource(context, write.var, project.tasks[task - 1].resource);
      uint32_t& by = writer[written.index];
      if (by == 0) by = task;
      if (by == task || by == ~0u) continue;
      const Var& var = project.var(written);
      if (uncopiedIn(context, var.type)) continue;  // a lock, or an object that contains one
      const Task &one = project.tasks[by - 1], &other = project.tasks[task - 1];
      if (isServed(context, var.type)) {
        const Task& server = serving(one, other);
        context.report(diag::TwoTasksMove, var.loc,
                       {string(context, var.name), string(context, one.name), string(context, other.name),
                        string(context, server.name)});
      } else {
        context.report(diag::TwoTasksWrite, var.loc,
                       {string(context, var.name), string(context, one.name), string(context, other.name)});
      }
      by = ~0u;
    }
  }
}

}  // namespace rung::sema
