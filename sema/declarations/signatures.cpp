// SPDX-License-Identifier: Apache-2.0
#include "sema/declarations/signatures.h"

#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/variables.h"
#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

// The type without references and aliases.
TypeId ProjectSignatures::plainType(TypeId type) const {
  const types::TypeTable& table = context_.types();
  type = table.resolve(type);
  if (table.info(type).kind == TypeKind::Reference) type = table.resolve(table.info(type).base);
  return type;
}

ProjectSignatures::Resolved ProjectSignatures::resolve(Entity entity) {
  Resolved resolved{entity, {}};
  if (entity.entityKind() == EntityKind::Var) resolved.type = plainType(context_.project.vars[entity.index].type);
  if (entity.entityKind() == EntityKind::Program) {
    const PouId program = context_.project.instances[entity.index].program;
    resolvePou(context_, program);
    resolved.type = context_.project.pou(program).record;
  }
  return resolved;
}

ProjectSignatures::Resolved ProjectSignatures::memberOf(const Resolved& base, NameId member) {
  const types::TypeTable& table = context_.types();
  TypeId record = base.type;
  if (record && table.info(record).kind == TypeKind::Pointer) {  // an interface, THIS
    if (!interfaceOf(context_, record)) return {};
    record = table.resolve(table.info(record).base);
  }
  if (!record && base.entity.entityKind() == EntityKind::Pou) {
    resolvePou(context_, PouId{base.entity.index});
    record = context_.project.pous[base.entity.index].record;
  }
  if (!record) return resolve(lookUpIn(context_, base.entity, member));
  if (table.info(record).kind != TypeKind::Record) return {};
  if (const VarId field = findMember(context_, record, member))
    return resolve(Entity::of(EntityKind::Var, field.index));
  const PouId object = pouOf(context_, record);
  return object ? resolve(findInObject(context_, object, context_.names().key(member))) : Resolved{};
}

ProjectSignatures::Resolved ProjectSignatures::resolve(ExprId path) {
  const Tree& tree = context_.tree();
  const ExprKind kind = tree.kind(path);
  switch (shape(kind)) {
    case ExprShape::Leaf:
      if (kind == ExprKind::Name) return resolve(lookUp(context_, tree.as<NameExpr>(path)));
      return kind == ExprKind::This || kind == ExprKind::Super ? ownObject(kind) : Resolved{};
    case ExprShape::Step: return resolveStep(path);
    case ExprShape::Operation:
    case ExprShape::Initializer:
    case ExprShape::Inserted: break;
  }
  return {};
}

ProjectSignatures::Resolved ProjectSignatures::ownObject(ExprKind kind) {
  PouId object = objectOf(context_);
  if (object && kind == ExprKind::Super) object = context_.project.pou(object).base;
  return {{}, object ? context_.project.pou(object).record : TypeId{}};
}

ProjectSignatures::Resolved ProjectSignatures::resolveStep(ExprId path) {
  const Tree& tree = context_.tree();
  const types::TypeTable& table = context_.types();
  const ExprKind kind = tree.kind(path);
  if (kind == ExprKind::BitAccess) return {};
  if (kind == ExprKind::Member) {
    const MemberExpr& node = tree.as<MemberExpr>(path);
    return memberOf(resolve(node.base), node.member);
  }
  const TypeId base = resolve(tree.base(path)).type;
  const TypeKind of = base ? table.info(base).kind : TypeKind::None;
  if (of == TypeKind::Pointer || (of == TypeKind::Array && kind == ExprKind::Index))
    return {{}, plainType(table.info(base).base)};
  return kind == ExprKind::Deref ? Resolved{{}, base} : Resolved{};
}

// The declared type of the result, if it is a name that means the same everywhere.
TypeExprId ProjectSignatures::plainResult(const Pou& pou) const {
  const Tree& tree = context_.tree();
  const TypeExprId result = pou.decl && pou.result ? tree.as<PouDecl>(pou.decl).result : TypeExprId{};
  const bool named = result && tree.kind(result) == TypeExprKind::Named;
  return named && context_.types().isElementary(context_.types().kind(pou.result)) ? result : TypeExprId{};
}

Signature ProjectSignatures::signatureOf(PouId id, SignatureKind kind) {
  resolvePou(context_, id);
  const Pou& pou = context_.project.pou(id);
  const auto [resolved, fresh] = pins_.try_emplace(id.index);
  std::vector<PinSignature>& pins = resolved->second;
  if (fresh) {
    for (const VarId var_id : pinsOf(context_, id)) {
      const Var& var = context_.project.var(var_id);
      const PinDirection direction = var.section == SectionKind::Output  ? PinDirection::Output
                                     : var.section == SectionKind::InOut ? PinDirection::InOut
                                                                         : PinDirection::Input;
      const bool is_bool = var.type && context_.types().kind(var.type) == TypeKind::Bool;
      pins.push_back({var.name, var.pragmas.aliases, direction, is_bool, var.pragmas.required, var.pragmas.lazy,
                      var.pragmas.extensible, var.init});
    }
  }
  return {kind, static_cast<bool>(pou.result), pins, plainResult(pou)};
}

Signature ProjectSignatures::signatureOf(const Resolved& resolved) {
  if (resolved.entity.entityKind() == EntityKind::Pou) {
    const PouId id{resolved.entity.index};
    switch (context_.project.pou(id).kind) {
      case PouKind::Function: return signatureOf(id, SignatureKind::Function);
      case PouKind::Method:
      case PouKind::Action: return signatureOf(id, SignatureKind::Method);
      case PouKind::Program: return signatureOf(id, SignatureKind::Program);
      case PouKind::FunctionBlock: return signatureOf(id, SignatureKind::Block);
      case PouKind::Class:
      case PouKind::Interface: return {SignatureKind::Other, false, {}};
    }
  }
  if (resolved.type && resolved.type != types::kError) {
    const PouId pou = pouOf(context_, resolved.type);
    if (pou && context_.project.pou(pou).kind == PouKind::FunctionBlock)
      return signatureOf(pou, SignatureKind::Instance);
    return {SignatureKind::Value, false, {}};
  }
  switch (resolved.entity.entityKind()) {
    case EntityKind::Var:
    case EntityKind::EnumValue:
    case EntityKind::Property: return {SignatureKind::Value, false, {}};
    case EntityKind::Type:
    case EntityKind::GlobalList:
    case EntityKind::Namespace:
    case EntityKind::Program:
    case EntityKind::Pou: return {SignatureKind::Other, false, {}};
    case EntityKind::None:
    case EntityKind::Error: break;
  }
  return {};
}

Signature ProjectSignatures::of(NameId name) {
  const std::string path(context_.names().string(name));
  size_t end = path.find('.');
  if (end == std::string::npos) return signatureOf(resolve(lookUp(context_, name)));
  Resolved resolved = resolve(lookUp(context_, context_.names().find(path.substr(0, end))));
  while (end != std::string::npos) {
    const size_t begin = end + 1;
    end = path.find('.', begin);
    resolved = memberOf(resolved, context_.names().find(path.substr(begin, end - begin)));
  }
  return signatureOf(resolved);
}
Signature ProjectSignatures::of(ExprId path) { return signatureOf(resolve(path)); }

std::span<const DeclId> ProjectSignatures::madeSections(const PouDecl& pou) {
  return context_.project.madeSections(pou);
}

std::string ProjectSignatures::typeUnlessBool(ExprId path) {
  const TypeId type = resolve(path).type;
  if (!type || type == types::kError || context_.types().plainKind(type) == TypeKind::Bool) return {};
  return context_.types().toString(type);
}

bool ProjectSignatures::fits(ExprId instance, ExprId block) {
  const Entity drawn = resolve(block).entity;
  const TypeId type = resolve(instance).type;
  const PouId own = type && type != types::kError ? pouOf(context_, type) : PouId{};
  if (drawn.entityKind() != EntityKind::Pou || !own) return true;
  const Pou& pou = context_.project.pou(own);
  const Pou& shown = context_.project.pous[drawn.index];
  if (pou.kind != PouKind::FunctionBlock || shown.kind != PouKind::FunctionBlock) return true;
  // Two libraries may have blocks of one name: a box shows it without the library's.
  return pou.instance.of || context_.names().same(pou.name, shown.name) || isKindOf(context_, own, PouId{drawn.index});
}

}  // namespace rung::sema
