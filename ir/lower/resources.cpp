// SPDX-License-Identifier: Apache-2.0
// Code that several resources run and that names a global variable of which each has its own: a copy of each such body
// for each resource. In: the lowered bodies, with the places that name such variables (noteGlobal). Out: copies whose
// places and calls are those of the resource, and program instances and block tasks that run them.
// Cost: one walk over all calls; copies of the bodies that name such variables or call one that does. Initial values
// and methods that are called virtually keep the variable of the first resource.
#include <set>

#include "ir/lower/lowering.h"

namespace rung::ir {

void ModuleLowering::noteGlobal(const Body& body, ExprId place, sema::VarId id) {
  const sema::Var& var = project.var(id);
  if (var.external) id = var.external;
  for (uint32_t i = 0; i < project.resource_globals.size(); ++i)
    if (project.resource_globals[i].all.front().var == id) resource_places_.push_back({&body, place, i});
}

namespace {

class ResourceCopies {
 public:
  ResourceCopies(ModuleLowering& in, std::span<const ResourcePlace> places) : in_(in), module_(in.module) {
    std::unordered_map<const Body*, uint32_t> number;
    for (uint32_t i = 1; i < module_.bodies.size(); ++i) number[&module_.bodies[i]] = i;
    places_.resize(module_.bodies.size());
    for (const ResourcePlace& place : places) places_[number.at(place.body)].push_back(place);
    for (const Body& body : module_.bodies) names_.insert(body.name.index);
    findDependent();
  }

  bool depends(BodyId body) const { return dependent_[body.index]; }

  // The body as the resource runs it: itself, or a copy.
  BodyId of(BodyId body, NameId resource) {
    if (!depends(body)) return body;
    const uint64_t key = uint64_t{body.index} << 32 | resource.index;
    if (const auto known = copies_.find(key); known != copies_.end()) return known->second;
    module_.bodies.push_back(Body(module_.bodies[body.index]));
    const BodyId id{static_cast<uint32_t>(module_.bodies.size() - 1)};
    copies_[key] = id;
    Body& copy = module_.bodies.back();
    copy.name = uniqueName(copy.name, resource);
    if (copy.kind == BodyKind::Block) copy.kind = BodyKind::Function;  // the record has its body already
    for (const ResourcePlace& place : places_[body.index]) replace(copy, place, resource);
    for (uint32_t i = 1; i < copy.stmts.size(); ++i) {
      if (copy.stmts[i].kind != StmtKind::Call) continue;
      CallStmt call = copy.stmts[i].as<CallStmt>();
      if (call.is_virtual) continue;
      call.callee = of(call.callee, resource);
      copy.stmts[i].set(call);
    }
    return id;
  }

 private:
  // Those with such a place, and those that call one.
  void findDependent() {
    dependent_.resize(module_.bodies.size());
    std::vector<std::vector<uint32_t>> callers(module_.bodies.size());
    std::vector<uint32_t> open;
    for (uint32_t i = 1; i < module_.bodies.size(); ++i) {
      for (const Stmt& stmt : module_.bodies[i].stmts)
        if (const auto* call = stmt.tryAs<CallStmt>()) callers[call->callee.index].push_back(i);
      if (!places_[i].empty()) open.push_back(i);
    }
    while (!open.empty()) {
      const uint32_t body = open.back();
      open.pop_back();
      if (dependent_[body] || module_.bodies[body].kind == BodyKind::Init) continue;
      dependent_[body] = true;
      open.insert(open.end(), callers[body].begin(), callers[body].end());
    }
  }

  NameId uniqueName(NameId name, NameId resource) {
    std::string text = std::string(module_.names.string(name)) + "__" + std::string(module_.names.string(resource));
    NameId made = module_.names.intern(text);
    while (!names_.insert(made.index).second) made = module_.names.intern(text += '_');
    return made;
  }

  void replace(Body& body, const ResourcePlace& place, NameId resource) {
    const sema::VarId id = in_.project.resource_globals[place.globals].of(module_.names.key(resource));
    const sema::Var& var = in_.project.var(id);
    Builder build(module_, body);
    const Loc loc = body.expr(place.place).loc;
    if (var.storage == sema::Storage::Image) {
      const uint32_t bit = var.image.is_bit ? var.image.bit : kNoBit;
      body.expr(place.place).set(ImageExpr{.area = var.image.area.index, .byte = var.image.byte, .bit = bit});
      return;
    }
    const uint32_t list = in_.instances.listIndex(var.list);
    const ExprId base = build.add(loc, module_.lists[list].record, GlobalExpr{.list = list});
    body.expr(place.place).set(FieldExpr{.base = base, .field = var.field});
  }

  ModuleLowering& in_;
  Module& module_;
  std::vector<std::vector<ResourcePlace>> places_;  // by BodyId
  std::vector<bool> dependent_;                     // by BodyId of those that are not copies
  std::unordered_map<uint64_t, BodyId> copies_;     // by BodyId and resource
  std::set<uint32_t> names_;
};

}  // namespace

void ModuleLowering::copyForResources() {
  if (resource_places_.empty()) return;
  ResourceCopies copies(*this, resource_places_);
  for (uint32_t i = 0; i < module.programs.size(); ++i) {
    ProgramInstance& program = module.programs[i];
    if (!program.resource) continue;
    if (program.run) {
      program.run = copies.of(program.run, program.resource);
    } else if (program.body && copies.depends(program.body)) {
      const BodyId code = copies.of(program.body, program.resource);
      const BodyId run = tasks.newActivation(i, "__run", module.body(code).loc);
      BodyLowering lowering(*this, module.body(run), {});
      lowering.statements.lowerActivation(i, code, {}, {});
      module.programs[i].run = run;
    }
  }
  for (BlockTask& task : module.block_tasks)
    if (const NameId resource = module.programs[task.program].resource) task.run = copies.of(task.run, resource);
}

}  // namespace rung::ir
