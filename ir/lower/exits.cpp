// SPDX-License-Identifier: Apache-2.0
// FB_Exit, called when objects end. In: the objects of a checked project. Out: for each record that holds an object
// with FB_Exit, at any depth, a function that ends all of them, and Module::exit, which ends those of the whole
// project. The order is the reverse of that of FB_Init: a derived object before its base, the whole before its parts,
// the last variable before the first. Codesys.
#include "ir/lower/lowering.h"

namespace rung::ir {

bool ModuleLowering::hasExit(TypeId type) {
  type = types.resolve(type);
  const TypeInfo& info = types.info(type);
  if (info.kind == TypeKind::Array) return hasExit(info.base);
  if (info.kind != TypeKind::Record || info.record_kind == types::RecordKind::Union) return false;
  const auto known = has_exit_.find(type.index);
  if (known != has_exit_.end()) return known->second;
  has_exit_[type.index] = false;
  bool found = !lifeMethodsOf(records.pouOf(type), "FB_Exit").empty();
  for (const types::Field& field : info.fields) found = found || (!field.by_reference && hasExit(field.type));
  return has_exit_[type.index] = found;
}

BodyId ModuleLowering::exitOf(TypeId record) {
  record = types.resolve(record);
  if (!hasExit(record)) return {};
  const auto known = exit_of_.find(record.index);
  if (known != exit_of_.end()) return known->second;
  const sema::PouId pou = records.pouOf(record);
  const BodyId created = addHelper(pou ? project.pou(pou).unique_name : types.info(record).name, pou, "~");
  exit_of_[record.index] = created;
  Body& body = module.body(created);
  body.self = record;
  BodyLowering lowering(*this, body, {});
  lowering.objects.lowerExit(lowering.code.self(body.loc), record);
  lowering.finish();
  return created;
}

BodyId ModuleLowering::exitCallOf(sema::PouId object) {
  const TypeId record = project.pou(object).record;
  if (const BodyId body = exitOf(record)) return body;
  const auto known = exit_of_.find(record.index);  // empty when only derived objects have an FB_Exit
  if (known != exit_of_.end()) return known->second;
  const BodyId created = addHelper(project.pou(object).unique_name, object, "~");
  exit_of_[record.index] = created;
  module.body(created).self = record;
  return created;
}

// A function without parameters that ends the objects of these lists and programs, the last first; none when there are
// no such objects.
BodyId ModuleLowering::endsOf(NameId name, const char* suffix, std::span<const Root> roots) {
  std::vector<Root> ends;
  std::copy_if(roots.begin(), roots.end(), std::back_inserter(ends),
               [&](const Root& root) { return hasExit(root.record); });
  if (ends.empty()) return {};
  const BodyId created = addHelper(name, {}, suffix);
  std::vector<BodyId> bodies;  // before the lowering begins: they create bodies
  bodies.reserve(ends.size());
  for (const Root& end : ends) bodies.push_back(exitOf(end.record));
  Body& body = module.body(created);
  BodyLowering lowering(*this, body, {});
  for (size_t i = ends.size(); i-- > 0;)
    lowering.code.append(body.loc, CallStmt{.callee = bodies[i], .self = lowering.code.place(ends[i], body.loc)});
  lowering.finish();
  return created;
}

void ModuleLowering::addExit() {
  addToTests(&ProgramInstance::exit, [&](NameId name, const Root& root) { return endsOf(name, "~test", {&root, 1}); });
  module.exit = endsOf(module.names.intern("FB_Exit"), "~", instances.roots());
}

void ObjectLowering::lowerExit(ExprId place, TypeId record) {
  const Loc loc = body_.loc;
  const std::vector<sema::PouId> methods = in_.lifeMethodsOf(in_.records.pouOf(record), "FB_Exit");
  rung::CallExpr node{};
  node.h.loc = loc;
  const ExprId copies = methods.empty() ? ExprId{} : isCopied(place);
  for (size_t i = methods.size(); i-- > 0;) {
    sema::Call call;
    call.kind = sema::CallKind::Method;
    call.pou = methods[i];
    calls().lowerFunctionCall(call, node, nullptr, asBase(copy(place), project_.pou(methods[i]).owner, loc), copies);
  }
  exitParts(place, record);
}

void ObjectLowering::exitParts(ExprId place, TypeId record) {
  const Loc loc = body_.loc;
  const auto count = static_cast<uint32_t>(types_.info(record).fields.size());
  for (uint32_t i = count; i-- > 0;) {
    const types::Field held = types_.info(record).fields[i];
    if (held.by_reference || !in_.hasExit(held.type) || in_.records.isKeptFromExit(record, i)) continue;
    const TypeId type = strip(held.type);
    const ExprId part = field(copy(place), i, type, loc);
    if (held.role == types::FieldRole::Base) {
      exitParts(part, type);
      continue;
    }
    exitElement(part, type);
  }
}

void ObjectLowering::exitElement(ExprId place, TypeId type) {
  const Loc loc = body_.loc;
  if (types_.kind(type) == TypeKind::Array) {
    std::vector<ExprId> indices;
    forEachElement(
        place, type, loc, 0, indices, [&](ExprId element) { exitElement(element, typeOf(element)); }, true);
    return;
  }
  append(loc, CallStmt{.callee = in_.exitOf(type), .self = place});
}

void ObjectLowering::callExit(ExprId place, bool exact, Loc loc) {
  const sema::PouId object = in_.records.pouOf(typeOf(place));
  const bool is_virtual = object && !exact && project_.pou(object).object.dispatched;
  const BodyId end = is_virtual ? in_.exitCallOf(object) : in_.exitOf(typeOf(place));
  if (!end) return;
  append(
      loc,
      CallStmt{.callee = end, .self = place, .is_virtual = is_virtual, .is_checked = is_virtual && in_.checksCasts()});
}

}  // namespace rung::ir
