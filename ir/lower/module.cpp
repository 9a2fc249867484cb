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

ModuleLowering::ModuleLowering(const sema::Project& from, const LowerOptions& with, Module& to)
    : project(from), options(with), module(to), tree(from.tree), types(to.types) {
  body_of_.resize(project.pous.size());
  list_index.resize(project.global_lists.size());
  pou_of_record_.resize(types.count());
  list_of_record_.resize(types.count());
  for (uint32_t i = 1; i < project.pous.size(); ++i)
    if (project.pous[i].record) pou_of_record_[project.pous[i].record.index] = {i};
  for (uint32_t i = 1; i < project.global_lists.size(); ++i)
    if (project.global_lists[i].record) list_of_record_[project.global_lists[i].record.index] = {i};
}

void ModuleLowering::run() {
  for (const sema::Var& var : project.vars) {
    if ((!var.start.constructor.index && !var.pragmas.no_exit) || var.storage == sema::Storage::Local) continue;
    const TypeId record = var.list  ? project.global_lists[var.list.index].record
                          : var.pou ? project.pou(var.pou).record
                                    : var.record;
    marked_[uint64_t{record.index} << 32 | var.field] = &var;
  }
  addLists();
  addPrograms();
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    if (pou.generic || pou.pragmas.operator_kind != sema::OperatorKind::None) continue;
    if (pou.kind == PouKind::Interface) continue;
    if (pou.excluded || (pou.library && !(options.used_of_libraries && pou.progress.used)))
      continue;  // follows when called
    bodyOf({i});
  }
  addTests();
  addActivations();
  addBlockTasks();
  do {  // an initial value may need a function that nothing else calls
    lowerBodies();
    for (List& list : module.lists) list.init = initOf(list.record);
    for (ProgramInstance& instance : module.programs) instance.init = initOf(instance.record);
    for (size_t i = 0; i < module.records.size(); ++i) {
      const BodyId init = initOf(module.records[i].type);
      module.records[i].init = init;
    }
    requestTaskCalls();
  } while (next_to_lower_ < to_lower_.size());
  addAfterInit();
  addExit();
  lowerBodies();  // the functions that these call
  addClasses();
  addDispatches();
  addTasks();
  addTaskCalls();
  simplifyLimits();
  copyForResources();
  markFaulting();
  addLocated();
  addAccessPaths();
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
    if (pou.cpp) {
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
  lowering.addNames();
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
  if (body.self) declareRecordsOf(body.self);
  for (sema::VarId var_id : pou.vars) {
    const sema::Var& var = project.var(var_id);
    if (var.storage != sema::Storage::Local || var.shared) continue;
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
    declareRecordsOf(type);
    body.locals.push_back({var.name, type, kind, isPassedByReference(types, kind, type), var.loc});
  }
  if (pou.result && types.kind(pou.result) != TypeKind::None) {
    TypeId type = types.resolve(pou.result);
    declareRecordsOf(type);
    body.result = type;
    body.locals.push_back(
        {pou.name, type, LocalKind::Result, isPassedByReference(types, LocalKind::Result, type), pou.loc});
  }
  to_lower_.push_back(id);
  if (Record* record = recordOf(pou.record)) record->body = known;
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

// ---- records and their initial values --------------------------------------------------------------------------

void ModuleLowering::declareRecordsOf(TypeId type) {
  to_declare_.push_back(type);
  if (is_declaring_) return;  // asked for by a record that is being declared
  is_declaring_ = true;
  while (!to_declare_.empty()) {
    const TypeId next = to_declare_.back();
    to_declare_.pop_back();
    declareRecord(next);
  }
  is_declaring_ = false;
}

// The records that a record holds come before it, those that it only points to after it: they may hold it.
void ModuleLowering::declareRecord(TypeId type) {
  type = types.resolve(type);
  const TypeInfo& info = types.info(type);
  if (info.kind == TypeKind::Array) return declareRecord(info.base);
  if (info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference) return to_declare_.push_back(info.base);
  if (info.kind != TypeKind::Record) return;
  if (!record_seen_.insert(type.index).second) return;
  for (const types::Field& f : info.fields) {
    if (f.by_reference)
      to_declare_.push_back(f.type);
    else
      declareRecord(f.type);
  }
  addRecord(type);
}

// The name and source of the POU to which a record or a body belongs.
template <class T>
static void takeHeader(T& to, const sema::Pou& owner) {
  to.name = owner.unique_name ? owner.unique_name : owner.name;
  to.library = owner.library;
  to.loc = owner.loc;
  to.file = owner.file;
}

void ModuleLowering::addRecord(TypeId type) {
  const TypeInfo& info = types.info(type);
  Record record;
  record.type = type;
  record.name = info.name;
  if (sema::PouId pou = pou_of_record_[type.index]) {
    takeHeader(record, project.pou(pou));
  }
  record_of_type_[type.index] = static_cast<uint32_t>(module.records.size());
  module.records.push_back(record);
  if (info.record_kind == types::RecordKind::Interface) return;
  if (sema::PouId pou = pou_of_record_[type.index]) {
    BodyId body = bodyOf(pou);  // may add records
    recordOf(type)->body = body;
  }
}

Record* ModuleLowering::recordOf(TypeId type) {
  const auto found = record_of_type_.find(type.index);
  return found == record_of_type_.end() ? nullptr : &module.records[found->second];
}

bool ModuleLowering::isZero(TypeId declared) {
  auto known = zero_.find(declared.index);
  if (known != zero_.end()) return known->second;
  zero_[declared.index] = false;  // ends the recursion for a record with a pointer to itself
  const bool result = beginsWithZeros(declared, types.info(declared));
  zero_[declared.index] = result;
  return result;
}

bool ModuleLowering::beginsWithZeros(TypeId declared, const TypeInfo& info) {
  if (declared.index < project.type_inits.size() && project.type_inits[declared.index]) return false;
  if (info.kind == TypeKind::Alias || info.kind == TypeKind::Array) return isZero(info.base);
  if (info.kind == TypeKind::Enum || info.kind == TypeKind::Subrange)
    return types::defaultValue(types, module.names, declared).bits == 0;
  if (info.kind != TypeKind::Record) return true;
  if (sema::PouId pou = pou_of_record_[declared.index]) {
    if (project.pou(pou).kind == PouKind::Interface) return true;
    if (project.pou(pou).object.dispatched || !lifeMethodsOf(pou, "FB_Init").empty()) return false;
    if (!calledAfterInit(pou).empty()) return false;
    for (sema::VarId id : project.pou(pou).vars) {
      const sema::Var& var = project.var(id);
      if (var.storage == sema::Storage::Image && var.init) return false;
      if (var.storage == sema::Storage::Field && (var.init || (var.section != SectionKind::InOut && !isZero(var.type))))
        return false;
    }
    return true;
  }
  if (sema::ListId list = list_of_record_[declared.index]) {
    for (sema::VarId id : project.global_lists[list.index].vars) {
      const sema::Var& var = project.var(id);
      if (var.init || (var.storage == sema::Storage::Global && !isZero(var.type))) return false;
    }
    return true;
  }
  bool has_inits = declared.index < project.field_inits.size();
  for (size_t i = 0; i < info.fields.size(); ++i) {
    if (has_inits && i < project.field_inits[declared.index].size() && project.field_inits[declared.index][i])
      return false;
    if (!isZero(info.fields[i].type)) return false;
    if (info.record_kind == types::RecordKind::Union && !info.overlaps) break;
  }
  return true;
}

BodyId ModuleLowering::initOf(TypeId type) {
  auto known = init_of_.find(type.index);
  if (known != init_of_.end()) return known->second;
  const sema::ListId of_list = list_of_record_[type.index];
  const bool sets_late = of_list && !project.late.empty() && list_index[of_list.index] == last_list_;
  if (isZero(type) && !sets_late) return init_of_[type.index] = {};
  module.bodies.emplace_back();
  BodyId id{static_cast<uint32_t>(module.bodies.size() - 1)};
  init_of_[type.index] = id;
  Body& body = module.bodies.back();
  const TypeInfo& info = types.info(type);
  sema::PouId pou = pou_of_record_[type.index];
  const sema::ListId list = of_list;
  body.name = info.name;
  if (pou) {
    takeHeader(body, project.pou(pou));
  }
  body.spelling = info.name ? info.name : body.name;
  body.kind = BodyKind::Init;
  body.self = type;

  BodyLowering lowering(*this, body, pou);
  Loc loc = body.loc;
  lowering.code.assign(lowering.code.self(loc), lowering.code.zero(type, loc), loc);
  auto storeVar = [&](sema::VarId id_of_var) {
    const sema::Var& var = project.var(id_of_var);
    if (var.storage == sema::Storage::Image) {
      if (var.init)
        lowering.objects.storeInitial(lowering.places.varPlace(id_of_var, var.loc), types.resolve(var.type), var.init,
                                      false);
      return;
    }
    // A POU's VAR_EXTERNAL and VAR_STAT are in global lists, which set them.
    if (var.storage != (pou ? sema::Storage::Field : sema::Storage::Global)) return;
    if (var.section == SectionKind::InOut || var.bits.is_bit || var.holds) return;
    if (!var.init && isZero(var.type)) return;
    lowering.objects.storeInitial(lowering.code.field(lowering.code.self(var.loc), var.field, var.type, var.loc),
                                  var.type, var.init, true);
  };
  if (pou) {
    for (sema::VarId var : project.pou(pou).vars)
      if (!project.var(var).start.late) storeVar(var);
    for (sema::VarId var : project.pou(pou).late) storeVar(var);
    if (project.pou(pou).object.dispatched) {
      sema::PouId first = pou;
      while (!project.pou(first).object.id_var) first = project.pou(first).base;
      const uint32_t field = project.var(project.pou(first).object.id_var).field;
      ExprId number = lowering.code.add(loc, types::kUDInt, ConstExpr{.number_of = type});
      ExprId place =
          lowering.code.field(lowering.code.asBase(lowering.code.self(loc), first, loc), field, types::kUDInt, loc);
      lowering.code.assign(place, number, loc);
    }
  } else if (list) {
    for (sema::VarId var : project.global_lists[list.index].vars)
      if (!project.var(var).start.late) storeVar(var);
    // Values that read other lists are set when all lists have theirs, and before those of programs.
    for (size_t i = 0; sets_late && i < project.late.size(); ++i) {
      const sema::Var& var = project.var(project.late[i]);
      lowering.objects.storeInitial(lowering.places.varPlace(project.late[i], var.loc), var.type, var.init,
                                    var.storage == sema::Storage::Global);
    }
  } else
    for (const bool written : {false, true})  // where members overlap, explicit values win
      for (uint32_t i = 0; i < info.fields.size(); ++i) {
        rung::ExprId init;
        if (type.index < project.field_inits.size() && i < project.field_inits[type.index].size())
          init = project.field_inits[type.index][i];
        if (info.overlaps ? init ? written : !written && !isZero(info.fields[i].type)
                          : !written && (init || !isZero(info.fields[i].type)))
          lowering.objects.storeInitial(lowering.code.field(lowering.code.self(loc), i, info.fields[i].type, loc),
                                        info.fields[i].type, init, !info.overlaps);
        if (info.record_kind == types::RecordKind::Union && !info.overlaps) break;
      }
  lowering.finish();
  return id;
}

// ---- lists, programs, tasks ------------------------------------------------------------------------------------

void ModuleLowering::addLists() {
  std::vector<std::pair<std::string, uint32_t>> order;
  for (uint32_t i = 1; i < project.global_lists.size(); ++i)
    if (project.global_lists[i].record)
      order.push_back({foldedIdentifier(project.names.string(project.global_lists[i].name)), i});
  std::sort(order.begin(), order.end());
  for (const auto& [name, index] : order) {
    const sema::GlobalList& list = project.global_lists[index];
    list_index[index] = static_cast<uint32_t>(module.lists.size());
    declareRecordsOf(list.record);
    module.lists.push_back({list.name, list.record, {}, list.init_slot, list.resource ? list.configuration : NameId{}});
    if (list.init_slot >= module.lists[last_list_].slot) last_list_ = list_index[index];
  }
}

std::vector<Root> ModuleLowering::roots() const {
  std::vector<Root> all;
  for (uint32_t i = 0; i < module.lists.size(); ++i) all.push_back({true, i, module.lists[i].record});
  for (uint32_t i = 0; i < module.programs.size(); ++i)
    if (!module.programs[i].is_test) all.push_back({false, i, module.programs[i].record});
  return all;
}

void ModuleLowering::addNames() {
  for (uint32_t i = 1; i < project.global_lists.size(); ++i) {
    list_index[i] = static_cast<uint32_t>(module.lists.size());
    module.lists.push_back({project.global_lists[i].name, project.global_lists[i].record, {}});
  }
  for (const sema::ProgramInstance& instance : project.instances) {
    const auto index = static_cast<uint32_t>(module.programs.size());
    program_of_instance_.push_back(index + 1);
    instance_of_.insert({instance.program.index, index});
    module.programs.emplace_back().name = instance.name;
    module.programs.back().record = project.pou(instance.program).record;
  }
}

void ModuleLowering::addPrograms() {
  program_of_instance_.resize(project.instances.size());
  for (const sema::ProgramInstance& instance : project.instances) {
    if (!instance.program) continue;
    program_of_instance_[static_cast<size_t>(&instance - project.instances.data())] =
        static_cast<uint32_t>(module.programs.size()) + 1;
    const sema::Pou& pou = project.pou(instance.program);
    ProgramInstance created;
    created.name = instance.name;
    created.record = pou.record;
    created.slot = pou.pragmas.init_slot;
    created.task = instance.task;
    created.retain = instance.retain;
    created.resource = instance.resource;
    created.configuration = instance.configuration;
    instance_of_.insert({instance.program.index, static_cast<uint32_t>(module.programs.size())});
    module.programs.push_back(created);
    module.programs.back().body = bodyOf(instance.program);
  }
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    const bool is_called = pou.kind == PouKind::Program && pou.pragmas.after_globals;
    if ((pou.pragmas.test || is_called) && !pou.excluded && pou.record) instanceOf({i});
    if (pou.pragmas.safe_values && !pou.excluded) module.safe = bodyOf({i});
    if (pou.pragmas.setup && !pou.excluded) module.setups.push_back(bodyOf({i}));
    if (pou.pragmas.teardown && !pou.excluded) module.teardowns.push_back(bodyOf({i}));
  }
}

uint32_t ModuleLowering::instanceOf(sema::PouId program) {
  auto known = instance_of_.find(program.index);
  if (known != instance_of_.end()) return known->second;
  const sema::Pou& pou = project.pou(program);
  uint32_t index = static_cast<uint32_t>(module.programs.size());
  instance_of_[program.index] = index;
  ProgramInstance created;
  created.name = pou.pragmas.test ? pou.unique_name : pou.name;
  created.record = pou.record;
  created.slot = pou.pragmas.init_slot;
  module.programs.push_back(created);
  BodyId body = bodyOf(program);
  module.programs[index].body = body;
  module.programs[index].is_test = pou.pragmas.test;
  return index;
}

void ModuleLowering::addTasks() {
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

void ModuleLowering::addAccessPaths() {
  for (const sema::AccessPath& path : project.access_paths) {
    if (path.root == sema::AccessPath::Root::Instance && program_of_instance_[path.index] == 0) continue;
    AccessPath created;
    created.name = path.name;
    created.prefix = path.prefix;
    created.configuration = path.configuration;
    created.type = types.resolve(path.type);
    created.read_only = path.read_only;
    if (path.located) {
      created.index = path.image.area.index;
      created.offset = path.image.byte;
      if (path.image.is_bit) created.bit = path.image.bit;
    } else {
      const bool of_list = path.root == sema::AccessPath::Root::List;
      created.root = of_list ? AccessPath::Root::List : AccessPath::Root::Program;
      created.index = of_list ? listIndex({path.index}) : programOfInstance(path.index);
      created.offset = path.offset;
      if (path.bit >= 0) created.bit = static_cast<uint32_t>(path.bit);
    }
    module.access_paths.push_back(created);
  }
}

void ModuleLowering::addLocated() {
  for (const sema::Var& var : project.vars) {
    if (var.storage != sema::Storage::Image || !var.name || var.external) continue;
    if (var.pou && project.pou(var.pou).excluded && !body_of_[var.pou.index]) continue;
    Located created;
    created.name = var.name;
    created.type = types.resolve(var.type);
    created.area = var.image.area.index;
    created.byte = var.image.byte;
    created.bit = var.image.is_bit ? var.image.bit : kNoBit;
    created.symbol_access = var.symbol_access;
    created.retain = var.retain;
    created.persistent = var.persistent;
    if (var.pou && project.pou(var.pou).kind == PouKind::Program) created.owner_program = instanceOf(var.pou) + 1;
    if (!var.pou && var.list) {
      const sema::GlobalList& list = project.global_lists[var.list.index];
      created.list = list.name;
      if (list.resource) created.configuration = list.configuration;
    }
    module.located.push_back(created);
  }
}

}  // namespace rung::ir
