// SPDX-License-Identifier: Apache-2.0
// Lowering of a whole project: which bodies, records, lists, program instances and tasks the module has. In: a checked
// sema::Project. Out: a complete ir::Module. The order of everything follows names and declarations, never hashing.
// Tests are not part of the product: sema checks them and marks them `excluded`, this file skips them, and no later
// phase sees them.
#include <algorithm>

#include "ir/lower/lowering.h"

namespace rung::ir {

void lower(const sema::Project& project, const LowerOptions& options, Module& module) {
  setPhase("lowering");
  ModuleLowering(project, options, module).run();
}

ModulePart::ModulePart(ModuleLowering& of) : all(of), project(of.project), module(of.module), types(of.types) {}

ModuleLowering::ModuleLowering(const sema::Project& from, const LowerOptions& with, Module& to)
    : project(from),
      options(with),
      module(to),
      tree(from.tree),
      types(to.types),
      records(*this),
      instances(*this),
      tasks(*this) {
  body_of_.resize(project.pous.size());
}

void ModuleLowering::run() {
  records.readMarks();
  instances.addLists();
  instances.addPrograms();
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    if (pou.generic || pou.pragmas.operator_kind != sema::OperatorKind::None) continue;
    if (pou.kind == PouKind::Interface) continue;
    if (pou.excluded || (pou.library && !(options.used_of_libraries && pou.progress.used)))
      continue;  // follows when called
    bodyOf({i});
  }
  addTests();
  tasks.addActivations();
  tasks.addBlockTasks();
  do {  // an initial value may need a function that nothing else calls
    lowerBodies();
    for (List& list : module.lists) list.init = initOf(list.record);
    for (ProgramInstance& instance : module.programs) instance.init = initOf(instance.record);
    for (size_t i = 0; i < module.records.size(); ++i) {
      const BodyId init = initOf(module.records[i].type);
      module.records[i].init = init;
    }
    tasks.requestCalls();
  } while (next_to_lower_ < to_lower_.size());
  addAfterInit();
  addExit();
  if (options.online_change) addLives();
  addMakers();
  lowerBodies();  // the functions that these call
  addClasses();
  addDispatches();
  tasks.addTasks();
  tasks.addCalls();
  simplifyLimits();
  copyForResources();
  markFaulting();
  instances.addLocated();
  instances.addAccessPaths();
  module.aligned_globals = project.options.aligned_globals;
  module.io_modules = project.io_modules;
  module.areas = project.options.areas;
  for (size_t area = 0; area < module.areas.size(); ++area) module.areas[area].bytes = project.area_bytes[area];
  setPhaseSubject("", 0);
}

sema::PouId ModuleLowering::lowerBodies() {
  while (next_to_lower_ < to_lower_.size()) {
    const sema::PouId id = to_lower_[next_to_lower_++];
    const sema::Pou& pou = project.pou(id);
    if (pou.pragmas.native || (pou.owner && (pou.object.modifiers & kAbstract) != 0)) continue;
    if (!pou.progress.checked()) return id;
    if (pou.cpp.is_body) {
      lowerCpp(id);
      continue;
    }
    std::string_view name = project.names.string(pou.name);
    setPhaseSubject(name.data(), name.size());
    Body& body = module.body(body_of_[id.index]);
    BodyLowering lowering(*this, body, id);
    lowering.statements.lowerPou();
  }
  return {};
}

sema::PouId lowerFunction(const sema::Project& project, sema::PouId function, const LowerOptions& options,
                          Module& module, BodyId& body) {
  ModuleLowering lowering(project, options, module);
  lowering.partial = true;
  lowering.instances.addNames();
  body = lowering.bodyOf(function);
  return lowering.lowerBodies();
}

// ---- bodies ----------------------------------------------------------------------------------------------------

BodyId ModuleLowering::bodyOf(sema::PouId id) {
  BodyId& known = body_of_[id.index];
  if (known) return known;
  const sema::Pou& pou = project.pou(id);
  module.bodies.emplace_back();
  known = {static_cast<uint32_t>(module.bodies.size() - 1)};
  Body& body = module.bodies.back();
  body.name = pou.unique_name ? pou.unique_name : pou.name;
  body.spelling = pou.name;
  body.kind = pou.kind == PouKind::Function || pou.owner ? BodyKind::Function : BodyKind::Block;
  if (pou.owner) {
    std::string spelling(project.names.string(project.pou(pou.owner).name));
    spelling.append(".").append(project.names.string(pou.name));
    body.spelling = module.names.intern(spelling);
    body.abstract = (pou.object.modifiers & kAbstract) != 0;
  }
  body.native = pou.pragmas.native;
  body.pure = pou.pragmas.pure;
  body.sized = pou.pragmas.sized;
  body.slice = pou.pragmas.slice;
  body.library = pou.library;
  body.library_name = pou.library_name;
  body.test = pou.pragmas.test;
  body.counted = !pou.library && !pou.pragmas.test && !pou.pragmas.test_only && !pou.pragmas.replaces;
  body.self = pou.owner ? project.pou(pou.owner).record : pou.record;
  body.loc = pou.loc;
  body.file = pou.file;
  if (body.self) records.declare(body.self);
  for (sema::VarId var_id : pou.vars) {
    const sema::Var& var = project.var(var_id);
    if (var.storage != sema::Storage::Local || var.sharing.field) continue;
    LocalKind kind = LocalKind::Variable;
    if (body.kind == BodyKind::Function) {
      if (var.section == SectionKind::Input) kind = LocalKind::Input;
      if (var.section == SectionKind::Output) kind = LocalKind::Output;
      if (var.section == SectionKind::InOut) kind = LocalKind::InOut;
      if (var.open_array.hidden_input) kind = LocalKind::Input;
    }
    TypeId type = types.resolve(var.type);
    if (types.isOpenArray(type)) {  // the address of the first element
      type = types.pointer(types.info(type).base);
      kind = LocalKind::Input;
    }
    records.declare(type);
    body.locals.push_back({var.name, type, kind, isPassedByReference(types, kind, type), var.loc});
  }
  if (pou.result && types.kind(pou.result) != TypeKind::None) {
    TypeId type = types.resolve(pou.result);
    records.declare(type);
    body.result = type;
    body.locals.push_back(
        {pou.name, type, LocalKind::Result, isPassedByReference(types, LocalKind::Result, type), pou.loc});
  }
  to_lower_.push_back(id);
  if (Record* record = records.find(pou.record)) record->body = known;
  return known;
}

// A body may fault when it has a check or calls a body that may.
void ModuleLowering::markFaulting() {
  std::vector<std::vector<uint32_t>> callers(module.bodies.size());
  std::vector<uint32_t> faulting;
  for (uint32_t i = 1; i < module.bodies.size(); ++i) {
    Body& body = module.bodies[i];
    body.may_fault = body.may_fault || body.cpp != 0;  // the functions that it calls may
    for (const Expr& expr : body.exprs) body.may_fault = body.may_fault || expr.checks != 0;
    for (const Stmt& stmt : body.stmts) {
      if (stmt.kind == StmtKind::Fault) body.may_fault = true;
      const auto* call = stmt.tryAs<CallStmt>();
      if (call == nullptr) continue;
      callers[call->callee.index].push_back(i);
      body.may_fault = body.may_fault || call->is_virtual;
    }
    if (body.may_fault) faulting.push_back(i);
  }
  while (!faulting.empty()) {
    uint32_t callee = faulting.back();
    faulting.pop_back();
    for (uint32_t caller : callers[callee]) {
      if (module.bodies[caller].may_fault) continue;
      module.bodies[caller].may_fault = true;
      faulting.push_back(caller);
    }
  }
}

// ---- initial values --------------------------------------------------------------------------------------------

// A variable of an object or list. A POU's VAR_EXTERNAL and VAR_STAT are in global lists, which set them.
void ModuleLowering::initVar(BodyLowering& lowering, sema::VarId id, sema::Storage storage) {
  const sema::Var& var = project.var(id);
  if (var.storage == sema::Storage::Image) {
    if (var.init)
      lowering.objects.storeInitial(lowering.places.varPlace(id, var.loc), types.resolve(var.type), var.init, false);
    return;
  }
  if (var.storage != storage) return;
  if (var.section == SectionKind::InOut || var.bits.is_bit || var.sharing.holds) return;
  if (!var.init && records.isZero(var.type)) return;
  lowering.objects.storeInitial(lowering.code.field(lowering.code.self(var.loc), var.field, var.type, var.loc),
                                var.type, var.init, true);
}

void ModuleLowering::initObject(BodyLowering& lowering, TypeId type, sema::PouId pou, Loc loc) {
  const sema::Pou& object = project.pou(pou);
  for (const sema::VarId var : object.vars)
    if (!project.var(var).start.late) initVar(lowering, var, sema::Storage::Field);
  for (const sema::VarId var : object.late) initVar(lowering, var, sema::Storage::Field);
  if (!object.object.dispatched) return;
  sema::PouId first = pou;
  while (!project.pou(first).object.id_var) first = project.pou(first).base;
  const uint32_t field = project.var(project.pou(first).object.id_var).field;
  const ExprId number = lowering.code.add(loc, types::kUDInt, ConstExpr{.number_of = type});
  const ExprId place =
      lowering.code.field(lowering.code.asBase(lowering.code.self(loc), first, loc), field, types::kUDInt, loc);
  lowering.code.assign(place, number, loc);
}

// Values that read other lists are set when all lists have theirs, and before those of programs.
void ModuleLowering::initList(BodyLowering& lowering, sema::ListId list, bool sets_late) {
  for (const sema::VarId var : project.global_lists[list.index].vars)
    if (!project.var(var).start.late) initVar(lowering, var, sema::Storage::Global);
  for (size_t i = 0; sets_late && i < project.late.size(); ++i) {
    const sema::Var& var = project.var(project.late[i]);
    lowering.objects.storeInitial(lowering.places.varPlace(project.late[i], var.loc), var.type, var.init,
                                  var.storage == sema::Storage::Global);
  }
}

// A structure. Where members overlap, explicit values win.
void ModuleLowering::initFields(BodyLowering& lowering, TypeId type, Loc loc) {
  const TypeInfo& info = types.info(type);
  for (const bool written : {false, true})
    for (uint32_t i = 0; i < info.fields.size(); ++i) {
      rung::ExprId init;
      if (type.index < project.field_inits.size() && i < project.field_inits[type.index].size())
        init = project.field_inits[type.index][i];
      if (info.overlaps ? init ? written : !written && !records.isZero(info.fields[i].type)
                        : !written && (init || !records.isZero(info.fields[i].type)))
        lowering.objects.storeInitial(lowering.code.field(lowering.code.self(loc), i, info.fields[i].type, loc),
                                      info.fields[i].type, init, !info.overlaps);
      if (info.record_kind == types::RecordKind::Union && !info.overlaps) break;
    }
}

BodyId ModuleLowering::initOf(TypeId type) {
  auto known = init_of_.find(type.index);
  if (known != init_of_.end()) return known->second;
  const sema::ListId list = records.listOf(type);
  const bool sets_late = list && !project.late.empty() && instances.isLast(list);
  if (records.isZero(type) && !sets_late) return init_of_[type.index] = {};
  module.bodies.emplace_back();
  BodyId id{static_cast<uint32_t>(module.bodies.size() - 1)};
  init_of_[type.index] = id;
  Body& body = module.bodies.back();
  const TypeInfo& info = types.info(type);
  const sema::PouId pou = records.pouOf(type);
  body.name = info.name;
  if (pou) takeHeader(body, project.pou(pou));
  body.spelling = info.name ? info.name : body.name;
  body.kind = BodyKind::Init;
  body.self = type;
  BodyLowering lowering(*this, body, pou);
  lowering.code.assign(lowering.code.self(body.loc), lowering.code.zero(type, body.loc), body.loc);
  if (pou)
    initObject(lowering, type, pou, body.loc);
  else if (list)
    initList(lowering, list, sets_late);
  else
    initFields(lowering, type, body.loc);
  lowering.finish();
  return id;
}

}  // namespace rung::ir
