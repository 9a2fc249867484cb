// SPDX-License-Identifier: Apache-2.0
// {attribute 'call_after_global_init_slot'} calls these methods when all variables have their initial values, by
// ascending slot. In: functions, programs and methods of a checked project. Out: Module::after_init, and
// ProgramInstance::after_init for the instances in a test; functions without parameters, or none. CODESYS, "Attribute:
// call_after_global_init_slot".
#include <algorithm>

#include "ir/lower/lowering.h"

namespace rung::ir {

bool ModuleLowering::holds(TypeId type, sema::PouId block) {
  type = types.resolve(type);
  const TypeKind kind = types.kind(type);
  if (kind == TypeKind::Array) return holds(types.info(type).base, block);
  if (kind != TypeKind::Record || types.info(type).record_kind == types::RecordKind::Union) return false;
  const uint64_t key = uint64_t{type.index} << 32 | block.index;
  if (const auto known = holds_.find(key); known != holds_.end()) return known->second;
  const sema::PouId object = records.pouOf(type);
  bool found = object && isKindOf(object, block);
  for (const types::Field& field : types.info(type).fields)
    found = found || (!field.by_reference && holds(field.type, block));
  return holds_[key] = found;
}

// Calls the method of every instance in a variable, at any depth.
void ObjectLowering::callInstances(ExprId place, sema::PouId method) {
  const Loc loc = body_.loc;
  const TypeId type = typeOf(place);
  if (types_.kind(type) == TypeKind::Array) {
    std::vector<ExprId> indices;
    forEachElement(place, type, loc, 0, indices, [&](ExprId element) { callInstances(element, method); });
    return;
  }
  const sema::PouId object = in_.records.pouOf(type);
  const bool is_instance = object && in_.isKindOf(object, project_.pou(method).owner);
  if (const sema::PouId found = is_instance ? in_.implementation(object, method) : sema::PouId{}) {
    sema::Call call;
    call.kind = sema::CallKind::Method;
    call.pou = found;
    rung::CallExpr node{};
    node.h.loc = loc;
    calls().lowerFunctionCall(call, node, nullptr, asBase(copy(place), project_.pou(found).owner, loc));
  }
  callParts(place, method);
}

// The same for the members of a structure or instance; those of its base are its own.
void ObjectLowering::callParts(ExprId place, sema::PouId method) {
  const TypeId type = typeOf(place);
  const auto count = static_cast<uint32_t>(types_.info(type).fields.size());
  for (uint32_t i = 0; i < count; ++i) {
    const types::Field held = types_.info(type).fields[i];
    if (held.by_reference || !in_.holds(held.type, project_.pou(method).owner)) continue;
    const ExprId part = field(copy(place), i, strip(held.type), body_.loc);
    if (held.role == types::FieldRole::Base)
      callParts(part, method);
    else
      callInstances(part, method);
  }
}

std::vector<sema::PouId> ModuleLowering::calledAfterGlobals() const {
  std::vector<sema::PouId> out;
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    const sema::PouId owner = pou.owner;
    if (!pou.pragmas.after_globals || pou.excluded || pou.generic || (owner && project.pou(owner).generic)) continue;
    out.push_back({i});
  }
  std::stable_sort(out.begin(), out.end(), [&](sema::PouId a, sema::PouId b) {
    return project.pou(a).pragmas.after_globals_slot < project.pou(b).pragmas.after_globals_slot;
  });
  return out;
}

// None when nothing is to be called.
BodyId ModuleLowering::afterInitOf(NameId name, const char* suffix, std::span<const sema::PouId> called,
                                   std::span<const Root> roots, bool is_test) {
  const auto isCalled = [&](sema::PouId id) {
    const sema::Pou& pou = project.pou(id);
    if (pou.kind == PouKind::Function) return !is_test;
    return std::any_of(roots.begin(), roots.end(), [&](const Root& root) {
      return pou.kind == PouKind::Program ? !root.is_list && root.record == pou.record : holds(root.record, pou.owner);
    });
  };
  std::vector<sema::PouId> wanted;
  for (const sema::PouId id : called)
    if (isCalled(id)) wanted.push_back(id);
  if (wanted.empty()) return {};
  const BodyId created = addHelper(name, {}, suffix);
  Body& body = module.body(created);
  BodyLowering lowering(*this, body, {});
  for (const sema::PouId id : wanted) {
    const sema::Pou& pou = project.pou(id);
    if (pou.kind == PouKind::Function) {
      sema::Call call;
      call.kind = sema::CallKind::Function;
      call.pou = id;
      rung::CallExpr node{};
      node.h.loc = body.loc;
      lowering.calls.lowerFunctionCall(call, node, nullptr);
      continue;
    }
    for (const Root& root : roots) {
      if (pou.kind != PouKind::Program) {
        if (holds(root.record, pou.owner)) lowering.objects.callInstances(lowering.code.place(root, body.loc), id);
      } else if (!root.is_list && root.record == pou.record) {
        const ProgramInstance& program = module.programs[root.index];
        if (program.run)
          lowering.code.append(body.loc, CallStmt{.callee = program.run});
        else
          lowering.code.append(body.loc, CallStmt{.callee = bodyOf(id), .self = lowering.code.place(root, body.loc)});
      }
    }
  }
  lowering.finish();
  return created;
}

void ModuleLowering::addAfterInit() {
  const std::vector<sema::PouId> called = calledAfterGlobals();
  if (called.empty()) return;
  addToTests(&ProgramInstance::after_init, [&](NameId name, const Root& root) {
    return afterInitOf(name, "~after_init", called, {&root, 1}, true);
  });
  module.after_init = afterInitOf(module.names.intern("after_init"), "~", called, instances.roots(), false);
}

// Whether a declaration of the block needs no arguments: FB_Init, its own or that of a base, has the two inputs of the
// system alone.
bool ModuleLowering::isMadeWithoutArguments(sema::PouId block) const {
  constexpr std::ptrdiff_t kOfTheSystem = 2;
  const std::vector<sema::PouId> methods = lifeMethodsOf(block, "FB_Init");
  return std::all_of(methods.begin(), methods.end(), [&](sema::PouId method) {
    const std::vector<sema::VarId>& vars = project.pou(method).vars;
    return std::count_if(vars.begin(), vars.end(),
                         [&](sema::VarId id) { return project.var(id).section == SectionKind::Input; }) <= kOfTheSystem;
  });
}

// For rung_init_instance: what a new instance needs beside its initial values.
void ModuleLowering::addMakers() {
  for (size_t i = 0; i < module.records.size(); ++i) {
    const TypeId record = module.records[i].type;
    const sema::PouId block = records.pouOf(record);
    if (!block || project.pou(block).kind != PouKind::FunctionBlock ||
        (project.pou(block).object.modifiers & kAbstract) != 0)
      continue;
    if (lifeMethodsOf(block, "FB_Init").empty() && calledAfterInit(block).empty()) continue;
    if (!isMadeWithoutArguments(block)) continue;
    const BodyId created = addHelper(project.pou(block).unique_name, block, "~new");
    module.makers.push_back(created);
    Body& body = module.body(created);
    body.self = record;
    BodyLowering lowering(*this, body, {});
    lowering.objects.storeInitial(lowering.code.self(body.loc), record, {}, true);
    lowering.finish();
  }
}

}  // namespace rung::ir
