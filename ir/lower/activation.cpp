// SPDX-License-Identifier: Apache-2.0
// Activation of program instances. In: connections (PROGRAM p : Main(in := x)), open addresses in instances (AT %I*)
// and initial values of VAR_CONFIG. Out: a `run` function for each program that needs more than its body called, and a
// `setup` function where an instance has initial values of its own. IEC 61131-3 ed. 3, 6.8.1.
#include "ir/lower/lowering.h"

namespace rung::ir {

void TaskLowering::addTasks() {
  for (const sema::Task& task : project.tasks) {
    Task created;
    created.name = task.name;
    created.resource = task.resource;
    created.kind = static_cast<TaskKind>(task.kind);
    created.interval_ns = task.interval_ns;
    created.priority = task.priority;
    created.trigger = task.trigger;
    created.external_event = task.external_event;
    created.watchdog_ns = task.watchdog_ns;
    created.sensitivity = task.sensitivity;
    created.duration_ns = task.duration_ns;
    module.tasks.push_back(created);
  }
}

void TaskLowering::addActivations() {
  using Path = sema::InstancePath;
  if (project.instance_paths.empty()) {
    for (uint32_t i = 0; i < project.instances.size(); ++i)
      if (all.instances.isCreated(i) && project.instances[i].connections)
        addActivation(all.instances.programOf(i), &project.instances[i], {});
    return;
  }
  auto pathsOf = [&](uint32_t instance, sema::PouId program) {
    std::vector<Path> own;
    for (const Path& path : project.instance_paths) {
      bool is_global = path.instance == Path::kNone && !path.program;
      if (is_global || (path.instance == instance && path.program == program)) own.push_back(path);
    }
    return own;
  };
  for (uint32_t i = 0; i < project.instances.size(); ++i)
    if (all.instances.isCreated(i))
      addActivation(all.instances.programOf(i), &project.instances[i], pathsOf(i, project.instances[i].program));
  for (uint32_t i = 1; i < project.pous.size(); ++i)
    if (project.pous[i].pragmas.test && !project.pous[i].excluded && project.pous[i].record)
      addActivation(all.instances.instanceOf({i}), nullptr, pathsOf(Path::kNone, {i}));
}

void TaskLowering::addActivation(uint32_t program, const sema::ProgramInstance* instance,
                                 std::span<const sema::InstancePath> paths) {
  rung::ExprId call = instance != nullptr ? instance->connections : rung::ExprId{};
  bool copies = false, sets = false;
  for (const sema::InstancePath& path : paths) {
    copies = copies || path.located;
    sets = sets || path.init || (path.located && project.var(path.var).init);
  }
  const Loc loc = instance != nullptr ? instance->loc : module.body(module.programs[program].body).loc;
  if (call || copies) {
    const BodyId id = newActivation(program, "__run", loc);
    BodyLowering lowering(all, module.body(id), {});
    lowering.statements.lowerActivation(program, module.programs[program].body, call, paths);
    module.programs[program].run = id;
  }
  if (sets) {
    const BodyId id = newActivation(program, "__setup", loc);
    BodyLowering lowering(all, module.body(id), {});
    lowering.statements.lowerSetup(program, paths);
    module.programs[program].setup = id;
  }
}

// A function without parameters that a program instance has for itself.
BodyId TaskLowering::newActivation(uint32_t program, const char* what, Loc loc) {
  module.bodies.emplace_back();
  const BodyId id{static_cast<uint32_t>(module.bodies.size() - 1)};
  Body& body = module.bodies.back();
  std::string unique = std::string(module.names.string(module.programs[program].name)) + what;
  if (NameId resource = module.programs[program].resource)
    unique = std::string(module.names.string(resource)) + "__" + unique;
  body.name = module.names.intern(unique);
  body.spelling = module.programs[program].name;
  body.kind = BodyKind::Function;
  body.loc = loc;
  body.file = project.sources.fileOf(body.loc);
  return id;
}

void TaskLowering::addBlockTasks() {
  for (const sema::BlockTask& task : project.block_tasks) {
    if (!all.instances.isCreated(task.instance)) continue;
    const uint32_t program = all.instances.programOf(task.instance);
    const sema::Var& block = project.var(task.block);
    module.bodies.emplace_back();
    const BodyId id{static_cast<uint32_t>(module.bodies.size() - 1)};
    Body& body = module.bodies.back();
    std::string unique(module.names.string(module.programs[program].name));
    unique.append("__").append(module.names.string(block.name)).append("__run");
    if (NameId resource = module.programs[program].resource)
      unique = std::string(module.names.string(resource)) + "__" + unique;
    body.name = module.names.intern(unique);
    body.spelling = block.name;
    body.kind = BodyKind::Function;
    body.loc = task.loc;
    body.file = project.sources.fileOf(body.loc);
    BodyLowering lowering(all, body, {});
    lowering.statements.lowerBlockTask(program, task.block);
    module.block_tasks.push_back({task.task, id, program});
  }
}

void StatementLowering::lowerBlockTask(uint32_t program, sema::VarId block) {
  const Loc loc = body_.loc;
  const sema::Var& var = project_.var(block);
  const ExprId instance =
      field(asBase(places().programPlace(program, loc), var.pou, loc), var.field, strip(var.type), loc);
  const BodyId code = in_.bodyOf(in_.records.pouOf(strip(var.type)));
  append(loc, CallStmt{.callee = code, .self = instance});
  body_.first = build_.block().first;
}

ExprId PlaceLowering::programPlace(uint32_t program, Loc loc) {
  return add(loc, in_.module.programs[program].record, ProgramExpr{.program = program});
}

ExprId PlaceLowering::imagePlace(const sema::ImageView& view, TypeId type, Loc loc) {
  return add(loc, strip(type),
             ImageExpr{.area = view.area.index, .byte = view.byte, .bit = view.is_bit ? view.bit : kNoBit});
}

ExprId PlaceLowering::instancePlace(uint32_t program, const sema::InstancePath& path) {
  const Loc loc = body_.loc;
  ExprId at = path.program ? programPlace(program, loc) : ExprId{};
  for (const sema::PathStep& step : path.path) {
    if (step.var && !at) {
      at = varPlace(step.var, loc);
    } else if (step.var) {
      const sema::Var& var = project_.var(step.var);
      at = var.storage == sema::Storage::Image ? imagePlace(var.image, var.type, loc)
                                               : field(at, var.field, strip(var.type), loc);
    } else {
      const TypeInfo& info = types_.info(typeOf(at));
      uint64_t rest = static_cast<uint64_t>(step.element);
      std::vector<ExprId> indices(info.dimensions.size());
      for (size_t d = indices.size(); d-- > 0;) {
        const types::Dimension& dimension = info.dimensions[d];
        const int64_t index = dimension.low + static_cast<int64_t>(rest % dimension.count());
        indices[d] = constant(types::kDInt, static_cast<uint64_t>(index), loc);
        rest /= dimension.count();
      }
      at = element(at, indices, loc);
    }
  }
  return at;
}

void StatementLowering::lowerActivation(uint32_t program, BodyId code, rung::ExprId call,
                                        std::span<const sema::InstancePath> paths) {
  const Loc loc = body_.loc;
  for (const sema::InstancePath& path : paths) {
    if (!path.located || project_.options.areas[path.image.area.index].owner == types::AreaOwner::Output) continue;
    const TypeId type = project_.var(path.var).type;
    assign(places().instancePlace(program, path), places().imagePlace(path.image, type, loc), loc);
  }
  if (call) {
    const rung::CallExpr& node = tree_.as<rung::CallExpr>(call);
    calls().lowerBlockCall(project_.call(sema::meaning(node.h).call), node, places().programPlace(program, loc));
  } else {
    append(loc, CallStmt{.callee = code, .self = places().programPlace(program, loc)});
  }
  for (const sema::InstancePath& path : paths) {
    if (!path.located || project_.options.areas[path.image.area.index].owner == types::AreaOwner::Input) continue;
    const TypeId type = project_.var(path.var).type;
    assign(places().imagePlace(path.image, type, loc), places().instancePlace(program, path), loc);
  }
  body_.first = build_.block().first;
}

void StatementLowering::lowerSetup(uint32_t program, std::span<const sema::InstancePath> paths) {
  const Loc loc = body_.loc;
  for (const sema::InstancePath& path : paths) {
    const sema::Var& var = project_.var(path.var);
    if (path.init) objects().storeInitial(places().instancePlace(program, path), var.type, path.init, false);
    // Without an initial value, the value in the image counts.
    if (path.located && (path.init || var.init))
      assign(places().imagePlace(path.image, var.type, loc), places().instancePlace(program, path), loc);
  }
  body_.first = build_.block().first;
}

}  // namespace rung::ir
