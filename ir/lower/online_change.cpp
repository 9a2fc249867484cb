// SPDX-License-Identifier: Apache-2.0
// What an online change needs of the program (rung/change.h). In: the lists and programs of a checked project. Out:
// Module::lives with functions on their records: one sets what every change sets, and located variables, of which the
// runtime gives those of before their values back; one calls FB_Reinit of the instances
// that the change copies, at any depth, and FB_Exit as in exits.cpp. FB_Init and FB_Exit get bInCopyCode from the
// runtime. CODESYS, "Methods FB_Init, FB_Reinit, FB_Exit", "Attribute: init_on_onlchange".
#include "ir/lower/lowering.h"

namespace rung::ir {

namespace {

uint64_t keyOf(Life life, TypeId record) { return uint64_t{static_cast<uint8_t>(life)} << 32 | record.index; }

}  // namespace

bool ModuleLowering::hasPart(Life life, TypeId type) {
  type = types.resolve(type);
  const TypeInfo& info = types.info(type);
  if (info.kind == TypeKind::Array) return hasPart(life, info.base);
  if (info.kind != TypeKind::Record || info.record_kind == types::RecordKind::Union) return false;
  const auto known = has_part_.find(keyOf(life, type));
  if (known != has_part_.end()) return known->second;
  has_part_[keyOf(life, type)] = false;
  bool found =
      life == Life::Reinit ? !lifeMethodsOf(records.pouOf(type), "FB_Reinit").empty() : !locatedWithValue(type).empty();
  for (uint32_t i = 0; i < info.fields.size() && !found; ++i) {
    const types::Field& field = info.fields[i];
    found = (life == Life::Refresh && records.setByChange(type, i) != nullptr) ||
            (!field.by_reference && hasPart(life, field.type));
  }
  return has_part_[keyOf(life, type)] = found;
}

// The variables of a list or program that are in the image and have an initial value.
std::vector<sema::VarId> ModuleLowering::locatedWithValue(TypeId record) const {
  const sema::PouId pou = records.pouOf(record);
  const sema::ListId list = records.listOf(record);
  if (!pou && !list) return {};
  std::vector<sema::VarId> found;
  for (const sema::VarId id : pou ? project.pou(pou).vars : project.global_lists[list.index].vars)
    if (project.var(id).storage == sema::Storage::Image && project.var(id).init) found.push_back(id);
  return found;
}

BodyId ModuleLowering::lifeOf(Life life, TypeId record) {
  record = types.resolve(record);
  if (!hasPart(life, record)) return {};
  const auto known = life_of_.find(keyOf(life, record));
  if (known != life_of_.end()) return known->second;
  const sema::PouId pou = records.pouOf(record);
  const BodyId created = addHelper(pou ? project.pou(pou).unique_name : types.info(record).name, pou,
                                   life == Life::Refresh ? "~refresh" : "~reinit");
  life_of_[keyOf(life, record)] = created;
  Body& body = module.body(created);
  body.self = record;
  BodyLowering lowering(*this, body, pou);
  lowering.objects.lowerLife(life, lowering.code.self(body.loc), record);
  lowering.finish();
  return created;
}

void ModuleLowering::addLives() {
  for (const Root& root : instances.roots()) {
    const BodyId refresh = lifeOf(Life::Refresh, root.record), reinit = lifeOf(Life::Reinit, root.record);
    module.lives.push_back({root.is_list, root.index, refresh, reinit, exitOf(root.record)});
  }
}

// A native function of the standard library, which programs do not name.
BodyId ModuleLowering::copiesTest() {
  if (copies_test_) return copies_test_;
  module.bodies.emplace_back();
  copies_test_ = {static_cast<uint32_t>(module.bodies.size() - 1)};
  Body& body = module.bodies.back();
  body.name = body.spelling = module.names.intern("HOST_COPIES");
  body.library_name = module.names.intern("Standard");
  body.native = body.library = true;
  body.result = types::kBool;
  const TypeId instance = types.pointer(types::kByte);
  types.layout(instance);
  body.locals.push_back({module.names.intern("instance"), instance, LocalKind::Input, false, {}});
  body.locals.push_back({body.name, types::kBool, LocalKind::Result, false, {}});
  return copies_test_;
}

// Whether a change copies the instance at a place; none where the module is not made for changes.
ExprId ObjectLowering::isCopied(ExprId instance) {
  if (!in_.options.online_change) return {};
  const Loc loc = body_.expr(instance).loc;
  const BodyId test = in_.copiesTest();
  const TypeId byte_pointer = in_.module.body(test).locals[0].type, own = types_.pointer(typeOf(instance));
  types_.layout(own);
  const ExprId address = convert(add(loc, own, AddressExpr{.place = copy(instance)}), byte_pointer, loc);
  const ExprId result = temp(types::kBool, loc);
  append(loc, CallStmt{.callee = test, .operands = list({&address, 1}), .result = result});
  return copy(result);
}

void ObjectLowering::lowerLife(Life life, ExprId place, TypeId record) {
  if (life == Life::Refresh)
    for (const sema::VarId id : in_.locatedWithValue(record)) {
      const sema::Var& var = project_.var(id);
      storeInitial(places().varPlace(id, var.loc), strip(var.type), var.init, false);
    }
  lifeOfParts(life, place, record);
  if (life == Life::Reinit) reinit(place, record);
}

// The members of a record. Those of its base are its own: their FB_Reinit is the one of the whole.
void ObjectLowering::lifeOfParts(Life life, ExprId place, TypeId record) {
  const Loc loc = body_.loc;
  const auto count = static_cast<uint32_t>(types_.info(record).fields.size());
  for (uint32_t i = 0; i < count; ++i) {
    const types::Field held = types_.info(record).fields[i];
    if (held.by_reference) continue;
    const sema::Var* const set = life == Life::Refresh ? in_.records.setByChange(record, i) : nullptr;
    if (set != nullptr) {
      storeInitial(field(copy(place), i, set->type, loc), set->type, set->init, false);
    } else if (in_.hasPart(life, held.type)) {
      const ExprId part = field(copy(place), i, strip(held.type), loc);
      if (held.role == types::FieldRole::Base)
        lifeOfParts(life, part, strip(held.type));
      else
        lifeOfPart(life, part, strip(held.type));
    }
  }
}

void ObjectLowering::lifeOfPart(Life life, ExprId place, TypeId type) {
  const Loc loc = body_.loc;
  if (types_.kind(type) == TypeKind::Array) {
    std::vector<ExprId> indices;
    forEachElement(place, type, loc, 0, indices, [&](ExprId element) { lifeOfPart(life, element, typeOf(element)); });
    return;
  }
  append(loc, CallStmt{.callee = in_.lifeOf(life, type), .self = place});
}

// FB_Reinit of the object itself, if the change copies it: its own one, or the nearest that it inherits.
void ObjectLowering::reinit(ExprId place, TypeId record) {
  const Loc loc = body_.loc;
  const std::vector<sema::PouId> methods = in_.lifeMethodsOf(in_.records.pouOf(record), "FB_Reinit");
  if (methods.empty()) return;
  const ExprId copies = isCopied(copy(place));
  const StmtId then = block([&] {
    rung::CallExpr node{};
    node.h.loc = loc;
    sema::Call call;
    call.kind = sema::CallKind::Method;
    call.pou = methods.back();
    calls().lowerFunctionCall(call, node, nullptr, asBase(copy(place), project_.pou(call.pou).owner, loc));
  });
  append(loc, IfStmt{.condition = copies, .then_block = then});
}

}  // namespace rung::ir
