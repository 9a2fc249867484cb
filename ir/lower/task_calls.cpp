// SPDX-License-Identifier: Apache-2.0
// Methods that each activation of a task calls in front of its programs ({before_task}) and after them ({after_task}),
// for every instance that the task serves. In: such methods, the tasks, lowered bodies. Out: Task::before and
// Task::after, and those of tests; functions without parameters, or none. An instance in a program belongs to the
// program's task; in a global variable, to the task of the highest priority among those whose code names that variable.
// One that no task names goes with the instances that its own methods name. Methods of the project run around those of
// libraries; among them in the order of declaration, those after the programs in reverse.
#include <algorithm>
#include <set>

#include "ir/lower/lowering.h"
#include "ir/reachable.h"

namespace rung::ir {

// A variable of a list or program that is or holds such instances.
struct TaskLowering::Held {
  Root root;
  uint32_t field;
};

namespace {

bool isTaskCall(const sema::Pou& pou) { return pou.pragmas.before_task || pou.pragmas.after_task; }

using NamedGlobals = std::set<std::pair<uint32_t, uint32_t>>;

// The variables of lists that bodies name: list and field.
NamedGlobals namedGlobals(const Module& module, const std::vector<BodyId>& roots) {
  NamedGlobals named;
  for (const BodyId id : reachableBodies(module, roots)) {
    const Body& body = module.body(id);
    for (size_t e = 1; e < body.exprs.size(); ++e) {
      const auto* const field = body.exprs[e].tryAs<FieldExpr>();
      if (field == nullptr) continue;
      if (const auto* const list = body.expr(field->base).tryAs<GlobalExpr>()) named.insert({list->list, field->field});
    }
  }
  return named;
}

bool isNamed(const NamedGlobals& named, const auto& held) { return named.count({held.root.index, held.field}) != 0; }

}  // namespace

// The methods of the blocks that have instances.
void TaskLowering::requestCalls() {
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    if (!isTaskCall(pou) || pou.excluded || project.pou(pou.owner).generic) continue;
    if (all.records.isDeclared(project.pou(pou.owner).record)) all.bodyOf({i});
  }
}

BodyId TaskLowering::callsOf(NameId name, const char* suffix, std::span<const sema::PouId> methods,
                             std::span<const Held> variables) {
  if (methods.empty() || variables.empty()) return {};
  const BodyId created = all.addHelper(name, {}, suffix);
  Body& body = module.body(created);
  BodyLowering lowering(all, body, {});
  for (const sema::PouId method : methods) {
    for (const Held& held : variables) {
      const TypeId type = types.info(held.root.record).fields[held.field].type;
      if (!all.holds(type, project.pou(method).owner)) continue;
      const ExprId root = lowering.code.place(held.root, body.loc);
      lowering.objects.callInstances(lowering.code.field(root, held.field, types.resolve(type), body.loc), method);
    }
  }
  lowering.finish();
  return created;
}

// The methods that have a body, those of the project first.
void TaskLowering::findMethods() {
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    if (!isTaskCall(project.pous[i]) || !all.knownBodyOf({i})) continue;
    (project.pous[i].pragmas.before_task ? before_ : after_).push_back({i});
  }
  for (std::vector<sema::PouId>* const methods : {&before_, &after_})
    std::stable_partition(methods->begin(), methods->end(),
                          [&](sema::PouId method) { return !project.pou(method).library; });
  std::reverse(after_.begin(), after_.end());
}

std::vector<TaskLowering::Held> TaskLowering::heldIn(const Root& root) const {
  std::vector<Held> held;
  const std::vector<types::Field>& fields = types.info(types.resolve(root.record)).fields;
  for (uint32_t i = 0; i < fields.size(); ++i) {
    const auto isHeld = [&](sema::PouId method) { return all.holds(fields[i].type, project.pou(method).owner); };
    if (fields[i].by_reference) continue;
    if (std::any_of(before_.begin(), before_.end(), isHeld) || std::any_of(after_.begin(), after_.end(), isHeld))
      held.push_back({root, i});
  }
  return held;
}

// Tells whether the methods of an instance name one of the others.
bool TaskLowering::goesWith(const Held& held, const std::vector<Held>& others) const {
  const TypeId type = types.info(held.root.record).fields[held.field].type;
  std::vector<BodyId> bodies;
  for (const std::vector<sema::PouId>* const methods : {&before_, &after_})
    for (const sema::PouId method : *methods)
      if (all.holds(type, project.pou(method).owner)) bodies.push_back(all.knownBodyOf(method));
  const NamedGlobals named = namedGlobals(module, bodies);
  return std::any_of(others.begin(), others.end(),
                     [&](const Held& other) { return other.root.is_list && isNamed(named, other); });
}

// Gives each global instance to the first task whose code names it, then to the first with whose instances it goes.
void TaskLowering::shareGlobals(const std::vector<Held>& globals, std::vector<std::vector<Held>>& of_task) const {
  std::vector<uint32_t> order(module.tasks.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return module.tasks[a].priority < module.tasks[b].priority; });
  NamedGlobals served;
  for (const uint32_t task : order) {
    const NamedGlobals named = namedGlobals(module, rootsOfTask(module, task));
    for (const Held& held : globals)
      if (isNamed(named, held) && served.insert({held.root.index, held.field}).second) of_task[task].push_back(held);
  }
  for (const Held& held : globals) {
    if (isNamed(served, held)) continue;
    const auto task =
        std::find_if(order.begin(), order.end(), [&](uint32_t each) { return goesWith(held, of_task[each]); });
    if (task != order.end()) of_task[*task].push_back(held);
  }
}

// The instances in a test, the globals that it names, and those that go with them.
std::vector<TaskLowering::Held> TaskLowering::heldBy(const Test& test, const std::vector<Held>& globals) const {
  std::vector<Held> own;
  for (uint32_t p = 0; p < module.programs.size(); ++p)
    if (module.programs[p].is_test && module.programs[p].body == test.body)
      own = heldIn({false, p, module.programs[p].record});
  const NamedGlobals named = namedGlobals(module, {test.body, test.setup});
  for (const Held& held : globals)
    if (isNamed(named, held)) own.push_back(held);
  const std::vector<Held> of_test = own;
  for (const Held& held : globals)
    if (!isNamed(named, held) && goesWith(held, of_test)) own.push_back(held);
  return own;
}

void TaskLowering::addCalls() {
  findMethods();
  if (before_.empty() && after_.empty()) return;
  std::vector<Held> globals;
  std::vector<std::vector<Held>> of_task(module.tasks.size());
  for (const Root& root : all.instances.roots()) {
    const std::vector<Held> held = heldIn(root);
    const uint32_t task = root.is_list ? 0 : module.programs[root.index].task;
    if (root.is_list) globals.insert(globals.end(), held.begin(), held.end());
    if (task != 0) of_task[task - 1].insert(of_task[task - 1].end(), held.begin(), held.end());
  }
  shareGlobals(globals, of_task);
  for (uint32_t i = 0; i < module.tasks.size(); ++i) {
    const BodyId first = callsOf(module.tasks[i].name, "~before", before_, of_task[i]);
    std::reverse(of_task[i].begin(), of_task[i].end());
    const BodyId last = callsOf(module.tasks[i].name, "~after", after_, of_task[i]);
    module.tasks[i].before = first;
    module.tasks[i].after = last;
  }
  for (Test& test : module.tests) {
    std::vector<Held> own = heldBy(test, globals);
    test.before = callsOf(test.name, "~before", before_, own);
    std::reverse(own.begin(), own.end());
    test.after = callsOf(test.name, "~after", after_, own);
  }
}

}  // namespace rung::ir
