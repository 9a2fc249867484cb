// SPDX-License-Identifier: Apache-2.0
// CONFIGURATION, RESOURCE, TASK and PROGRAM … WITH: the tasks and program instances of the project, or the one task of
// a project without a configuration. docs/language.md "Tasks and configuration".
#include "sema/declarations/configuration.h"

#include <algorithm>
#include <unordered_map>

#include "frontend/source/scanner.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/expressions.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/namespaces.h"
#include "sema/declarations/task_triggers.h"
#include "sema/declarations/variables.h"
#include "sema/fixes.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

using types::TypeKind;
using types::TypeTable;

namespace {

constexpr int64_t kUsualPriority = 31, kLowestPriority = 65535;

// A part of a configuration with its own globals: the configuration itself, or a resource.
struct Part {
  NameId configuration, resource;
  FileId file;
};

template <class Visit>
void forEachMember(Context& context, Visit visit) {
  const Tree& tree = context.tree();
  for (const FileUnit& unit : tree.files) {
    for (const DeclId id : tree.list(unit.decls)) {
      if (tree.kind(id) != DeclKind::Configuration) continue;
      const ConfigurationDecl& configuration = tree.as<ConfigurationDecl>(id);
      Part part{configuration.name, {}, unit.file};
      for (const DeclId member : tree.list(configuration.members)) {
        if (tree.kind(member) != DeclKind::Resource) {
          visit(part, member);
          continue;
        }
        const ResourceDecl& resource = tree.as<ResourceDecl>(member);
        Part inner{configuration.name, resource.name, unit.file};
        for (uint32_t r = 0; r < resource.members.count; ++r) visit(inner, tree.list(resource.members)[r]);
      }
    }
  }
}

// The word in a setting that is not a variable: FREEWHEELING, AX_INTERRUPT_1, 'event'.
std::string settingOf(Context& context, ExprId expr) {
  const Tree& tree = context.tree();
  if (tree.kind(expr) == ExprKind::Name) return std::string(context.names().string(tree.as<NameExpr>(expr).name));
  if (tree.kind(expr) == ExprKind::Literal) {
    const LiteralExpr& literal = tree.as<LiteralExpr>(expr);
    if (literal.literal() == LiteralKind::String || literal.literal() == LiteralKind::WString) {
      return std::string(tree.string(literal.string()));
    }
  }
  return {};
}

struct TaskReader {
  Context& context;
  Task& task;
  bool has_kind = false, has_interval = false, has_single = false;
  ExprId trigger = {};

  // A time in nanoseconds. A literal keeps digits that TIME would cut: T#500us is a valid interval.
  std::optional<int64_t> time(ExprId& expr, std::string_view setting) {
    const Tree& tree = context.tree();
    if (tree.kind(expr) == ExprKind::Literal && tree.as<LiteralExpr>(expr).literal() == LiteralKind::Duration) {
      return static_cast<int64_t>(tree.as<LiteralExpr>(expr).value());
    }
    const TypeId type = context.expressions->check(context, expr, types::kTime);
    if (type == types::kError) return std::nullopt;
    if (!TypeTable::isDuration(context.types().plainKind(type))) {
      context.report(diag::TaskSettingType, tree.begin(expr), {setting, "a TIME"});
      return std::nullopt;
    }
    const auto value = requireConstant(context, expr, {});
    if (!value) return std::nullopt;
    return types::convert(context.types(), *value, types::kLTime).value.asSigned();
  }

  std::optional<int64_t> number(ExprId& expr, std::string_view setting, int64_t low, int64_t high) {
    const auto value = constantBound(context, expr);
    if (!value) return std::nullopt;
    if (*value >= low && *value <= high) return value;
    context.report(diag::TaskSettingRange, context.tree().begin(expr),
                   {setting, std::to_string(low), std::to_string(high)});
    return std::nullopt;
  }

  void kind(ExprId expr) {
    const std::string word = upper(settingOf(context, expr));
    has_kind = true;
    if (word == "CYCLIC") {
      task.kind = TaskKind::Cyclic;
    } else if (word == "FREEWHEELING") {
      task.kind = TaskKind::Freewheeling;
    } else if (word == "EVENT") {
      task.kind = TaskKind::Event;
    } else if (word == "STATUS") {
      task.kind = TaskKind::Status;
    } else if (word == "EXTERNAL") {
      task.kind = TaskKind::External;
    } else {
      context.report(diag::TaskKindUnknown, context.tree().begin(expr));
    }
  }

  // CODESYS has the priorities 0 to 31; the standard gives no limit (ed. 3, 6.8.2).
  void priority(ExprId& expr) {
    const auto value =
        number(expr, "PRIORITY", 0, context.profile().high_priorities ? kLowestPriority : kUsualPriority);
    if (!value) return;
    task.priority = static_cast<uint32_t>(*value);
    task.priority_loc = context.tree().begin(expr);
    if (*value > kUsualPriority)
      context.report(diag::PriorityUnusual, context.tree().begin(expr), {std::to_string(*value)});
  }

  // Forbids settings that a task does not have.
  //   fails   TASK t(INTERVALL := T#10ms);                E0811, did you mean `INTERVAL`?
  void setting(Argument& argument) {
    const std::string name = upper(context.names().string(argument.pin.name));
    if (!argument.value) {
      if (argument.pin.name) context.report(diag::TaskSettingType, argument.pin.loc, {"`" + name + "`", "a value"});
      return;
    }
    if (context.tree().kind(argument.value) == ExprKind::Error) return;
    if (name == "INTERVAL") {
      if (const auto ns = time(argument.value, name)) {
        has_interval = *ns != 0 || !has_single;
        if (*ns < 0 || (*ns == 0 && !has_single)) {
          context.report(diag::TaskInterval, context.tree().begin(argument.value));
        } else {
          task.interval_ns = *ns;
          task.interval_loc = context.tree().begin(argument.value);
        }
      }
    } else if (name == "PRIORITY") {
      priority(argument.value);
    } else if (name == "SINGLE") {
      has_single = true;
      trigger = argument.value;
    } else if (name == "KIND") {
      kind(argument.value);
    } else if (name == "TRIGGER") {
      trigger = argument.value;
    } else if (name == "WATCHDOG") {
      task.watchdog_loc = context.tree().begin(argument.value);
      if (const auto ns = time(argument.value, name)) task.watchdog_ns = *ns;
    } else if (name == "SENSITIVITY") {
      if (const auto value = number(argument.value, name, 0, 1'000'000))
        task.sensitivity = static_cast<uint32_t>(*value);
    } else {
      const std::string_view written = context.names().string(argument.pin.name);
      if (argument.pin.name)
        context.report(diag::TaskSettingUnknown, argument.pin.loc, {written})
            .didYouMean(
                nearest(written, {"INTERVAL", "PRIORITY", "SINGLE", "KIND", "TRIGGER", "WATCHDOG", "SENSITIVITY"}));
    }
  }

  // Forbids a task without what starts it.
  //   fails   TASK t(KIND := STATUS);                     E0819
  void checkTrigger(Loc loc) {
    if (task.kind == TaskKind::External) {
      if (trigger) task.external_event = settingOf(context, trigger);
      if (task.external_event.empty()) {
        context.report(diag::TaskNeedsTrigger, loc, {context.names().string(task.name), "the name of an event"});
      }
      return;
    }
    if ((task.kind == TaskKind::Event || task.kind == TaskKind::Status) && !trigger)
      context.report(diag::TaskNeedsTrigger, loc, {context.names().string(task.name), "a BOOL variable"});
  }

  void read(const TaskDecl& decl) {
    for (uint32_t pass = 0; pass < 2; ++pass) {  // SINGLE first: it overrides INTERVAL := 0
      for (uint32_t i = 0; i < decl.settings.count; ++i) {
        Argument argument = context.tree().list(decl.settings)[i];
        argument.value = codeOf(context, argument.value);
        const bool is_single = sameIdentifier(context.names().string(argument.pin.name), "SINGLE");
        if (is_single == (pass == 0)) setting(argument);
      }
    }
    if (!has_kind) {
      task.kind = has_single ? TaskKind::Event : has_interval ? TaskKind::Cyclic : TaskKind::Freewheeling;
    }
    if (task.kind == TaskKind::Cyclic && !has_interval) {
      context.report(diag::TaskInterval, decl.h.loc);
    }
    checkTrigger(decl.h.loc);
  }
};

// The trigger of an event or status task, resolved when all program instances are known.
struct Trigger {
  uint32_t task;  // index into Project::tasks
  ExprId expr;
  Part part;
};

// A resource's part of the project: its globals and program instances come before those of others.
Context atPart(Context& context, const Part& part) {
  Context there = at(context, {}, part.file, false, regionOfFile(context, part.file));
  if (part.resource) there.resource = keyOf(context, part.resource);
  return there;
}

void resolveTriggers(Context& context, std::span<const Trigger> triggers) {
  for (const Trigger& trigger : triggers) {
    Task& task = context.project.tasks[trigger.task];
    if (task.kind != TaskKind::Event && task.kind != TaskKind::Status) continue;
    Context there = atPart(context, trigger.part);
    task.trigger = triggerPath(there, trigger.expr, context.names().string(task.name));
  }
}

struct DeclaredTask {
  NameId key, configuration_key, resource_key;
  uint32_t number;
};

NameId keyIfNamed(const Context& context, NameId name) { return name ? keyOf(context, name) : NameId{}; }

// The number of a task that a resource sees, or 0 with a report.
uint32_t findTask(Context& context, const Part& part, const Ident& wanted, std::span<const DeclaredTask> tasks) {
  const NameId key = keyOf(context, wanted.name);
  uint32_t found = 0;
  std::vector<std::string_view> names;
  const NameId configuration = keyIfNamed(context, part.configuration);
  for (const DeclaredTask& task : tasks) {
    if (task.configuration_key != configuration) continue;
    if (task.resource_key && !(part.resource && keyOf(context, part.resource) == task.resource_key)) continue;
    if (task.key == key) found = task.number;
    names.push_back(context.names().string(context.project.tasks[task.number - 1].name));
  }
  const std::string_view text = context.names().string(wanted.name);
  if (found == 0 && !context.tree().lost_names)
    context.report(diag::UnknownTask, wanted.loc, {text}).didYouMean(nearest(text, names));
  return found;
}

// PROGRAM p WITH t : Main (block WITH task): the task runs the block independently of the program. IEC 61131-3 ed. 3
// table 62, 6b.
//   fails   PROGRAM p WITH t : Main (level WITH slow) where level : INT       E0891
void addBlockTasks(Context& context, const Part& part, const ProgramInstanceDecl& decl, uint32_t instance,
                   std::span<const DeclaredTask> tasks) {
  Project& project = context.project;
  const PouId program = project.instances[instance].program;
  for (uint32_t i = 0; i + 1 < decl.block_tasks.count; i += 2) {
    const Ident block = context.tree().list(decl.block_tasks)[i], task = context.tree().list(decl.block_tasks)[i + 1];
    const VarId found = findMember(context, project.pou(program).record, block.name);
    const TypeId type = found ? context.types().resolve(project.var(found).type) : TypeId{};
    const NamedType* named = type ? context.scopes.named(type) : nullptr;
    const PouId pou = named == nullptr ? PouId{} : named->pou;
    if (!pou || project.pou(pou).kind != PouKind::FunctionBlock) {
      if (type != types::kError)
        context.report(diag::NoBlockOfProgram, block.loc,
                       {context.names().string(block.name), context.names().string(project.pou(program).name)});
      continue;
    }
    const uint32_t number = findTask(context, part, task, tasks);
    if (number == 0) continue;
    project.pou(pou).progress.used = true;
    noteName(context, entity(found), block.loc);
    ++project.var(found).used.reads;
    project.block_tasks.push_back({instance, found, number, block.loc});
  }
}

// The task of programs that name none: runs as often as possible, after all others. IEC 61131-3 ed. 3, 6.8.2 and table
// 62, 6c. It has no source location.
uint32_t backgroundTask(Context& context, const Part& part) {
  std::vector<Task>& tasks = context.project.tasks;
  std::string name = "background";
  for (uint32_t i = 0; i < tasks.size(); ++i) {
    if (!(tasks[i].resource == part.resource)) continue;
    if (!tasks[i].loc) return i + 1;
    if (sameIdentifier(context.names().string(tasks[i].name), name)) name += '_';
  }
  Task task;
  task.resource = part.resource;
  task.configuration = part.configuration;
  task.name = context.names().intern(name);
  task.kind = TaskKind::Freewheeling;
  task.priority = kUsualPriority;
  for (const Task& other : tasks) task.priority = std::max(task.priority, other.priority);
  tasks.push_back(task);
  return static_cast<uint32_t>(tasks.size());
}

static void reportWithoutTask(Context& context, const ProgramInstanceDecl& decl,
                              const std::vector<DeclaredTask>& tasks) {
  const std::string name = toString(context, decl.name);
  Report report = context.report(diag::ProgramWithoutTask, decl.h.loc, {name});
  if (tasks.size() == 1 && !name.empty())
    report.insert({decl.h.loc.offset + static_cast<uint32_t>(name.size())},
                  " WITH " + toString(context, context.project.tasks[tasks[0].number - 1].name), Sureness::Proposal);
}

// Forbids an instance of a POU that is not a program, an undeclared task, and connections at the instance.
//   passes  PROGRAM p WITH t : Main;
//   fails   PROGRAM p WITH tt : Main;                     E0815, did you mean `t`?
void addInstance(Context& context, const Part& part, const ProgramInstanceDecl& decl,
                 const std::vector<DeclaredTask>& tasks) {
  Project& project = context.project;
  ProgramInstance instance;
  instance.retain = decl.qualifiers.retain;
  instance.name = decl.name;
  instance.resource = part.resource;
  instance.configuration = part.configuration;
  instance.loc = decl.h.loc;
  if (decl.type.empty()) return;  // reported by the parser
  const Ident type = context.tree().list(decl.type)[decl.type.count - 1];
  const NameId type_key = keyOf(context, type.name);
  Entity found;
  if (decl.type.count > 1 && findNamespace(context, context.tree().list(decl.type)[0].name)) {
    found = lookUpQualified(context, decl.type);
    if (found.entityKind() == EntityKind::Error) return;
  }
  if (!found) found = context.scopes.pous_and_types.find(type_key);
  if (!found) found = lookUpOpened(context, type_key, type.loc, true);
  if (!found) found = lookUpLibrary(context, type_key);
  if (found.entityKind() == EntityKind::Pou && project.pous[found.index].kind == PouKind::Program) {
    instance.program = PouId{found.index};
    noteName(context, found, type.loc);
  } else {
    std::vector<std::string_view> programs;
    for (const Pou& pou : project.pous) {
      if (pou.kind == PouKind::Program && pou.name && !pou.library)
        programs.push_back(context.names().string(pou.name));
    }
    const std::string_view text = context.names().string(type.name);
    if (!context.tree().lost_names)
      context.report(diag::NoProgram, type.loc, {text}).didYouMean(nearest(text, programs));
    return;
  }
  if (decl.task.name) {
    instance.task = findTask(context, part, decl.task, tasks);
  } else if (context.profile().programs_without_task) {
    instance.task = backgroundTask(context, part);
  } else {
    reportWithoutTask(context, decl, tasks);
  }
  if (!decl.arguments.empty()) {
    const ExprId callee = makeName(context, type.name, found, type.loc);
    instance.connections = context.build().call(callee, context.code().copy(decl.arguments), type.loc, type.loc);
    context.expressions->checkConnections(context, instance.connections, instance.program);
  }
  for (const ProgramInstance& other : project.instances) {
    if (!context.names().same(other.name, instance.name) || !(other.resource == instance.resource) ||
        !(other.configuration == instance.configuration))
      continue;
    reportTwice(context, instance.name, instance.loc, other.loc);
    return;
  }
  const auto index = static_cast<uint32_t>(project.instances.size());
  project.instances.push_back(instance);
  addBlockTasks(context, part, decl, index, tasks);
  const NameId key = keyOf(context, instance.name);
  if (!context.scopes.pous_and_types.find(key)) {
    context.scopes.qualifiers.insert(key, Entity::of(EntityKind::Program, index));
  }
}

// A program that may run without being asked for: none of a library or test.
bool isMainProgram(Context& context, const Pou& pou) {
  return pou.kind == PouKind::Program && !pou.pragmas.test && !pou.library && pou.name &&
         libraryOfSource(context, pou.file) == kNoLibrary;
}

// PLC_PRG or MAIN if there is one, else every PROGRAM in source order, in one cyclic task.
void addDefaultTask(Context& context) {
  Project& project = context.project;
  PouId only;
  for (const char* name : {"PLC_PRG", "MAIN"}) {
    const NameId id = context.names().find(name);
    const Entity found = id ? context.scopes.pous_and_types.find(keyOf(context, id)) : Entity{};
    if (only || found.entityKind() != EntityKind::Pou) continue;
    if (isMainProgram(context, project.pous[found.index])) only = PouId{found.index};
  }
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const Pou& pou = project.pous[i];
    if (!isMainProgram(context, pou) || (only && only.index != i)) continue;
    if (project.tasks.empty()) {
      Task task;
      task.name = context.names().intern("MainTask");
      task.interval_ns = project.options.default_interval_ns;
      task.priority = 1;
      project.tasks.push_back(task);
    }
    ProgramInstance instance;
    instance.name = pou.name;
    instance.program = PouId{i};
    instance.task = 1;
    instance.loc = pou.loc;
    project.instances.push_back(instance);
  }
}

// VAR_EXTERNAL of a resource creates nothing: it names globals that must exist, with the same type.
// IEC 61131-3 ed. 3 table 62, 13.
void checkExternals(Context& context, const Part& part, const SectionDecl& section) {
  if (section.section != SectionKind::External) return;
  Context there = atPart(context, part);
  NameMap names;
  std::vector<VarId> externals;
  for (uint32_t i = 0; i < section.vars.count; ++i) {
    declareVars(there, context.tree().list(section.vars)[i], section, {}, {}, &names, externals);
  }
  for (const VarId external : externals) {
    ensureVarType(there, external);
    ensureInitialValue(there, external);
  }
}

}  // namespace

void collectConfigurations(Context& context) {
  const Tree& tree = context.tree();
  std::unordered_map<uint32_t, NameId> resources;  // by the key of a program: the only resource that runs it, or none
  forEachMember(context, [&](const Part& part, DeclId member) {
    if (tree.kind(member) == DeclKind::ProgramInstance) {
      const ProgramInstanceDecl& decl = tree.as<ProgramInstanceDecl>(member);
      if (decl.type.empty()) return;
      const NameId key = keyOf(context, tree.list(decl.type)[decl.type.count - 1].name);
      const NameId resource = part.resource ? keyOf(context, part.resource) : NameId{};
      NameId& only = resources.try_emplace(key.index, resource).first->second;
      if (!(only == resource)) only = {};
      const Entity mark = Entity::of(EntityKind::Program, 0);
      if (!context.scopes.instantiated.once.insert(key, mark)) context.scopes.instantiated.again.insert(key, mark);
      return;
    }
    if (tree.kind(member) != DeclKind::Section) return;
    const SectionDecl& section = tree.as<SectionDecl>(member);
    if (section.section == SectionKind::Access) return;    // access_paths.cpp
    if (section.section == SectionKind::Config) return;    // instance_paths.cpp
    if (section.section == SectionKind::External) return;  // resolveConfigurations
    const NameId name = part.resource ? part.resource : part.configuration;
    const ListId list = listNamed(context, std::string(context.names().string(name)), part.file, section.h.loc,
                                  context.scopes.qualifiers);
    context.project.global_lists[list.index].configuration = part.configuration;
    context.project.global_lists[list.index].resource = part.resource;
    addGlobals(context, list, member, context.scopes.globals);
  });
  for (uint32_t i = 1; i < context.project.pous.size(); ++i) {
    const Pou& pou = context.project.pous[i];
    const auto found = resources.find(keyOf(context, pou.name).index);
    if (pou.kind == PouKind::Program && !pou.library && found != resources.end())
      context.scopes.pous[i].resource = found->second;
  }
}

void resolveConfigurations(Context& context) {
  const Tree& tree = context.tree();
  Project& project = context.project;
  std::vector<DeclaredTask> tasks;
  std::vector<Trigger> triggers;
  bool configured = false;
  forEachMember(context, [&](const Part& part, DeclId member) {
    if (tree.kind(member) == DeclKind::ProgramInstance) configured = true;
    if (tree.kind(member) == DeclKind::Section) checkExternals(context, part, tree.as<SectionDecl>(member));
    if (tree.kind(member) != DeclKind::Task) return;
    const TaskDecl& decl = tree.as<TaskDecl>(member);
    const NameId configuration = keyIfNamed(context, part.configuration);
    const NameId resource_key = keyIfNamed(context, part.resource);
    for (const DeclaredTask& other : tasks) {
      if (other.key == keyOf(context, decl.name) && other.configuration_key == configuration &&
          other.resource_key == resource_key) {
        reportTwice(context, decl.name, decl.h.loc, project.tasks[other.number - 1].loc);
        return;
      }
    }
    Task task;
    task.name = decl.name;
    task.resource = part.resource;
    task.configuration = part.configuration;
    task.priority = 1;
    task.loc = decl.h.loc;
    Context there = atPart(context, part);
    TaskReader reader{.context = there, .task = task};
    reader.read(decl);
    if (reader.trigger) triggers.push_back({static_cast<uint32_t>(project.tasks.size()), reader.trigger, part});
    project.tasks.push_back(task);
    tasks.push_back(
        {keyOf(context, decl.name), configuration, resource_key, static_cast<uint32_t>(project.tasks.size())});
  });
  if (!configured) {
    if (project.tasks.empty()) addDefaultTask(context);
    return resolveTriggers(context, triggers);
  }
  forEachMember(context, [&](const Part& part, DeclId member) {
    if (tree.kind(member) != DeclKind::ProgramInstance) return;
    Context there = atPart(context, part);
    addInstance(there, part, tree.as<ProgramInstanceDecl>(member), tasks);
  });
  resolveTriggers(context, triggers);
}

// PLC_PRG runs without a task, as often as possible and after all others. TM/TP manual 1.2 and 1.6.
void addFreeProgram(Context& context) {
  Project& project = context.project;
  const NameId name = context.names().find("PLC_PRG");
  const Entity found = name ? context.scopes.pous_and_types.find(keyOf(context, name)) : Entity{};
  if (found.entityKind() != EntityKind::Pou || project.tasks.empty()) return;
  const Pou& pou = project.pous[found.index];
  if (!isMainProgram(context, pou)) return;
  for (const Project::CallEdge& call : project.call_edges)
    if (call.callee.index == found.index && !project.pou(call.caller).pragmas.test_only &&
        !project.pou(call.caller).pragmas.test)
      return;
  for (const ProgramInstance& instance : project.instances)
    if (instance.program.index == found.index) return;
  const Task& neighbour = project.tasks.front();
  Task task;
  task.name = pou.name;
  task.kind = TaskKind::Freewheeling;
  task.priority = kUsualPriority;
  task.resource = neighbour.resource;
  task.configuration = neighbour.configuration;
  ProgramInstance instance;
  instance.name = pou.name;
  instance.program = PouId{found.index};
  instance.resource = neighbour.resource;
  instance.configuration = neighbour.configuration;
  instance.loc = pou.loc;
  project.tasks.push_back(task);
  instance.task = static_cast<uint32_t>(project.tasks.size());
  project.instances.push_back(instance);
}

// The tasks that a section of rung.project names, as `fast` or `Resource.fast`.
//   fails   [task fsat] duration = 12ms                   E0815, did you mean `fast`?
static std::vector<uint32_t> tasksCalled(Context& context, std::string_view wanted, Loc loc) {
  std::vector<uint32_t> found;
  std::vector<std::string_view> names;
  const std::vector<Task>& tasks = context.project.tasks;
  for (uint32_t i = 0; i < tasks.size(); ++i) {
    const std::string_view name = context.names().string(tasks[i].name);
    names.push_back(name);
    const std::string path = toString(context, tasks[i].resource) + "." + std::string(name);
    if (sameIdentifier(name, wanted) || sameIdentifier(path, wanted)) found.push_back(i);
  }
  if (found.empty()) context.report(diag::UnknownTask, loc, {wanted}).didYouMean(nearest(wanted, names));
  return found;
}

void setTaskDurations(Context& context) {
  for (const TaskDuration& duration : context.project.options.task_durations)
    for (const uint32_t task : tasksCalled(context, duration.task, duration.loc))
      context.project.tasks[task].duration_ns = duration.duration_ns;
}

void setIoModules(Context& context) {
  for (const ConfiguredModule& configured : context.project.options.io_modules) {
    context.project.io_modules.push_back(configured.module);
    if (configured.task.empty()) continue;
    const std::vector<uint32_t> tasks = tasksCalled(context, configured.task, configured.task_loc);
    if (!tasks.empty()) context.project.io_modules.back().task = tasks[0] + 1;
  }
}

}  // namespace rung::sema
