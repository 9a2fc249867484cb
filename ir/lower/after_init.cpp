// What {attribute 'call_after_global_init_slot'} calls when all variables have their initial values, by ascending slot.
// In: functions, programs and methods of a checked project. Out: Module::after_init, and ProgramInstance::after_init
// for the instances in a test; functions without parameters, or none. CODESYS, "Attribute:
// call_after_global_init_slot".
#include <algorithm>

#include "ir/lower/lowering.h"

namespace rung::ir {

bool ModuleLowering::holds(TypeId type, sema::PouId block) {
  type = types.resolve(type);
  const TypeInfo& info = types.info(type);
  if (info.kind == TypeKind::Array) return holds(info.base, block);
  if (info.kind != TypeKind::Record || info.record_kind == types::RecordKind::Union) return false;
  if (const sema::PouId pou = pouOfRecord(type); pou && isKindOf(pou, block)) return true;
  for (const types::Field& field : info.fields)
    if (!field.by_reference && holds(field.type, block)) return true;
  return false;
}

// Calls the method of every instance in a variable, at any depth.
void ObjectLowering::callInstances(ExprId place, sema::PouId method) {
  const Loc loc = body_.loc;
  const TypeId type = typeOf(place);
  const sema::PouId block = project_.pou(method).owner;
  if (types_.kind(type) == TypeKind::Array) {
    std::vector<ExprId> indices;
    forEachElement(place, type, loc, 0, indices, [&](ExprId element) { callInstances(element, method); });
    return;
  }
  const sema::PouId object = in_.pouOfRecord(type);
  const bool is_instance = object && in_.isKindOf(object, block);
  if (is_instance) {
    if (const sema::PouId found = in_.implementation(object, method)) {
      sema::Call call;
      call.kind = sema::CallKind::Method;
      call.pou = found;
      rung::CallExpr node{};
      node.h.loc = loc;
      calls().lowerFunctionCall(call, node, nullptr, asBase(copy(place), project_.pou(found).owner, loc));
    }
  }
  const auto count = static_cast<uint32_t>(types_.info(type).fields.size());
  for (uint32_t i = 0; i < count; ++i) {
    const types::Field held = types_.info(type).fields[i];
    if (held.by_reference || !in_.holds(held.type, block)) continue;
    const bool is_base = held.role == types::FieldRole::Base;
    if (!is_base) {
      callInstances(field(copy(place), i, strip(held.type), loc), method);
      continue;
    }
    if (!is_instance) continue;
    // The base is a part of this instance; the instances in it are not.
    const ExprId base = field(copy(place), i, strip(held.type), loc);
    callParts(base, method);
  }
}

// The same for the members of the base of an instance.
void ObjectLowering::callParts(ExprId base, sema::PouId method) {
  const Loc loc = body_.loc;
  const TypeId type = typeOf(base);
  const sema::PouId block = project_.pou(method).owner;
  const auto count = static_cast<uint32_t>(types_.info(type).fields.size());
  for (uint32_t i = 0; i < count; ++i) {
    const types::Field held = types_.info(type).fields[i];
    if (held.by_reference || !in_.holds(held.type, block)) continue;
    const ExprId part = field(copy(base), i, strip(held.type), loc);
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
                                   std::span<const uint32_t> lists, std::span<const uint32_t> programs, bool is_test) {
  struct Root {
    bool is_list;  // else a program
    uint32_t index;
    TypeId record;
  };
  std::vector<Root> roots;
  for (const uint32_t list : lists) roots.push_back({true, list, module.lists[list].record});
  for (const uint32_t p : programs) roots.push_back({false, p, module.programs[p].record});
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
      const auto place = [&] {
        return root.is_list ? lowering.code.add(body.loc, root.record, GlobalExpr{.list = root.index})
                            : lowering.code.add(body.loc, root.record, ProgramExpr{.program = root.index});
      };
      if (pou.kind != PouKind::Program) {
        if (holds(root.record, pou.owner)) lowering.objects.callInstances(place(), id);
      } else if (!root.is_list && root.record == pou.record) {
        const ProgramInstance& program = module.programs[root.index];
        if (program.run)
          lowering.code.append(body.loc, CallStmt{.callee = program.run});
        else
          lowering.code.append(body.loc, CallStmt{.callee = bodyOf(id), .self = place()});
      }
    }
  }
  lowering.finish();
  return created;
}

void ModuleLowering::addAfterInit() {
  const std::vector<sema::PouId> called = calledAfterGlobals();
  if (called.empty()) return;
  std::vector<uint32_t> lists, programs;
  for (uint32_t i = 0; i < module.lists.size(); ++i) lists.push_back(i);
  for (uint32_t i = 0; i < module.programs.size(); ++i) {
    if (!module.programs[i].is_test) {
      programs.push_back(i);
      continue;
    }
    const BodyId after = afterInitOf(module.programs[i].name, "~after_init", called, {}, {&i, 1}, true);
    module.programs[i].after_init = after;
  }
  module.after_init = afterInitOf(module.names.intern("after_init"), "~", called, lists, programs, false);
}

}  // namespace rung::ir
