// SPDX-License-Identifier: Apache-2.0
// Names in expressions: variables, enumeration items, members of records, and qualified names (`GVL.x`, `Lib.f`).
// In: NameExpr, TypedNameExpr, MemberExpr. Out: their entity and type. Called for every operand of every body.
#include "sema/bodies/names.h"

#include "frontend/syntax/standard_names.h"
#include "sema/access.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/implicit_checks.h"
#include "sema/bodies/objects.h"
#include "sema/bodies/outside_access.h"
#include "sema/bodies/temporaries.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/namespaces.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/diagnostics.h"
#include "sema/fixes.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

const char* kindName(EntityKind kind) {
  switch (kind) {
    case EntityKind::Type: return "a type";
    case EntityKind::GlobalList: return "a list of globals";
    case EntityKind::Namespace: return "a namespace";
    case EntityKind::Program: return "a program";
    case EntityKind::None:
    case EntityKind::Error:
    case EntityKind::Var:
    case EntityKind::Pou:
    case EntityKind::Property:
    case EntityKind::EnumValue: return "a name";
  }
  return "a name";
}

const char* kindName(PouKind kind) {
  switch (kind) {
    case PouKind::Function: return "a function; call it with `(...)`";
    case PouKind::FunctionBlock: return "a block type; declare an instance of it";
    case PouKind::Class: return "a class; declare an instance of it";
    case PouKind::Interface: return "an interface; declare a variable of it";
    case PouKind::Method: return "a method; call it with `(...)`";
    case PouKind::Action: return "an action; call it with `()`";
    case PouKind::Program: return "a program; name one of its variables after a `.`";
  }
  return "a POU";
}

TypeId typeOfVar(const Context& context, VarId id) {
  const TypeId type = context.symbols.var(id).type;
  return type ? type : types::kError;
}

// A member of type BIT becomes a bit of the hidden byte that holds it.
TypeId useBit(Context& context, ExprId& expr, const Var& var) {
  const Tree& tree = context.tree();
  const ExprId bit = context.build().bitAccess(expr, var.bits.bit, 1, tree.loc(expr));
  context.code().expr(bit).in_parens = tree.expr(expr).in_parens;
  Meaning& byte = context.meaning(expr);
  byte.type = types::kByte;
  Meaning& known = context.meaning(bit);
  known.type = types::kBool;
  known.is_bit_member = true;
  known.is_constant = byte.is_constant;
  known.is_writable = byte.is_writable;
  context.replace(expr, bit);
  return types::kBool;
}

TypeId useVar(Context& context, ExprId& expr, VarId id, Access access) {
  markAccess(context, id, access, context.tree().loc(expr));
  const Var& var = context.symbols.var(id);
  ExprHeader& header = context.code().expr(expr);
  meaning(header).is_constant = var.constant && var.has_value;
  meaning(header).is_writable = !var.constant;
  const TypeId type = typeOfVar(context, id);
  if (var.bits.is_bit && !meaning(header).is_constant) return useBit(context, expr, var);
  return meaning(header).type = type;
}

TypeId useEnumValue(Context& context, ExprId expr, uint32_t index, bool bare) {
  const EnumValue& item = context.symbols.enum_values[index];
  noteMention(context, Entity::of(EntityKind::EnumValue, index), context.tree().loc(expr), Access::Read);
  ExprHeader& header = context.code().expr(expr);
  meaning(header).is_constant = 1;
  meaning(header).type = item.type;
  const types::TypeInfo& info = context.types().info(item.type);
  if (item.type == context.items_of) {  // in its own declaration; a number while items are being numbered
    if (context.scopes.named(item.type)->resolved == State::Busy) meaning(header).type = info.base;
    return meaning(header).type;
  }
  if (bare && info.name && info.qualified) {
    const std::string_view type = string(context, context.types().info(item.type).name);
    context.report(diag::QualifiedEnumItem, header.loc, {string(context, item.name), type})
        .insert(header.loc, std::string(type) + ".", Sureness::Sure);
    return meaning(header).type = types::kError;
  }
  return item.type;
}

bool isQualifier(Entity entity) {
  const EntityKind kind = entity.entityKind();
  return kind == EntityKind::Pou || kind == EntityKind::Type || kind == EntityKind::GlobalList ||
         kind == EntityKind::Namespace || kind == EntityKind::Program;
}

// An entity as an operand; a qualifier has no type and is not a value.
TypeId useEntity(Context& context, ExprId& expr, Entity entity, Loc loc, NameId name, Access access, bool bare) {
  ExprHeader& header = context.code().expr(expr);
  if (isQualifier(entity)) noteName(context, entity, loc);
  switch (entity.entityKind()) {
    case EntityKind::Var: {
      const Var& var = context.symbols.vars[entity.index];
      if (bare && !checkUseInMethod(context, var, loc)) return meaning(header).type = types::kError;
      if (bare && var.access == AccessLevel::Private && var.pou && !mayAccess(context, var.access, var.pou, name, loc))
        return meaning(header).type = types::kError;
      return useVar(context, expr, VarId{entity.index}, access);
    }
    case EntityKind::EnumValue: return useEnumValue(context, expr, entity.index, bare);
    case EntityKind::None:
    case EntityKind::Error: return meaning(header).type = types::kError;
    case EntityKind::Pou: {
      const Pou& pou = context.symbols.pou(PouId{entity.index});
      if (access == Access::Qualifier && (pou.kind == PouKind::Program || pou.kind == PouKind::Function || pou.owner))
        return meaning(header).type = {};
      const bool is_block = pou.kind == PouKind::FunctionBlock || pou.kind == PouKind::Class;
      if (access == Access::Qualifier && is_block && context.profile().block_names_qualify)
        return meaning(header).type = {};
      if (takesAddress(access) && pou.record) return meaning(header).type = pou.record;
      if (isFirstReport(context, name))
        context.report(diag::NotAValue, loc, {string(context, name), kindName(pou.kind)});
      return meaning(header).type = types::kError;
    }
    case EntityKind::Property: return useMember(context, expr, entity, {}, access);
    case EntityKind::Type:
      if (takesAddress(access)) return meaning(header).type = TypeId{entity.index};
      [[fallthrough]];
    case EntityKind::GlobalList:
    case EntityKind::Namespace:
    case EntityKind::Program:
      if (access == Access::Qualifier) return meaning(header).type = {};
      if (isFirstReport(context, name))
        context.report(diag::NotAValue, loc, {string(context, name), kindName(entity.entityKind())});
      return meaning(header).type = types::kError;
  }
  return meaning(header).type = types::kError;
}

// The references among the bases of a member, which were checked as qualifiers.
void callReferenceChecks(Context& context, ExprId base, Access access) {
  const Tree& tree = context.tree();
  for (ExprId at = base;;) {
    if (tree.kind(at) == ExprKind::Member) {
      at = tree.as<MemberExpr>(at).base;
      continue;
    }
    if (tree.kind(at) != ExprKind::Deref) return;
    DerefExpr& node = context.code().as<DerefExpr>(at);
    const ExprId reference = node.base;
    if (context.types().kind(context.type(reference)) != TypeKind::Reference) return;
    callPointerCheck(context, node.base, meaning(node.h).type, access);
    at = reference;
    access = Access::Read;
  }
}

// The base of a member: a value, or a qualifier (then without a type).
TypeId checkBase(Context& context, ExprId& base, Access access) {
  const ExprKind kind = context.tree().kind(base);
  if (kind != ExprKind::Name && kind != ExprKind::Member) return check(context, base, {}, access);
  const TypeId type = check(context, base, {}, Access::Qualifier);
  if (!type || access == Access::Qualifier) return type;
  callReferenceChecks(context, base, access);
  bool is_part = true;  // of the variable that is used: not after an instance, whose own members are used
  for (ExprId at = base;; at = context.tree().as<MemberExpr>(at).base) {  // of a.b.c both a and b
    const Entity entity = entityOf(context, at);
    if (entity.entityKind() == EntityKind::Var)
      markAccess(context, VarId{entity.index}, access, context.tree().loc(at));
    if (context.tree().kind(at) != ExprKind::Member) return type;
    is_part = is_part && !isInstance(context, context.type(at));
    if (is_part && entity.entityKind() == EntityKind::Var &&
        !checkOutsideAccess(context, context.tree().as<MemberExpr>(at), VarId{entity.index}, access))
      return types::kError;
  }
}

std::string_view nearestField(Context& context, TypeId record, NameId written) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(record));
  std::vector<std::string_view> candidates;
  const PouId object = pouOf(context, record);  // whose VAR_INST and hidden fields cannot be named
  for (const types::Field& field : info.fields)
    if (!object || findMember(context, record, field.name)) candidates.push_back(string(context, field.name));
  std::erase_if(candidates, [](std::string_view name) { return name.starts_with("__"); });
  for (const types::BitMember& bit : info.bits) candidates.push_back(string(context, bit.name));
  for (const auto& item : info.items) candidates.push_back(string(context, item.first));
  return nearest(string(context, written), candidates);
}

std::string_view nearestIn(Context& context, Entity qualifier, NameId written) {
  if (qualifier.entityKind() == EntityKind::Type) return nearestField(context, TypeId{qualifier.index}, written);
  if (qualifier.entityKind() == EntityKind::GlobalList) {
    return nearestField(context, context.symbols.global_lists[qualifier.index].record, written);
  }
  return {};
}

bool isBlockType(const Context& context, PouId pou) {
  const Pou& type = context.symbols.pou(pou);
  return (type.kind == PouKind::FunctionBlock || type.kind == PouKind::Class) && !type.owner;
}

// `Motor.MAX_SPEED`: a constant is the same in all instances (codesys). Forbids other members without an instance.
//   passes  Motor.MAX_SPEED      fails  Motor.speed      E0518
Entity constantOfBlock(Context& context, PouId block, const MemberExpr& node) {
  declarePou(context, block);
  const Entity found = context.scopes.pous[block.index].names.find(keyOf(context, node.member));
  if (found.entityKind() == EntityKind::Var && context.symbols.var(VarId{found.index}).constant) {
    ensureInitialValue(context, VarId{found.index});
    if (context.symbols.var(VarId{found.index}).has_value) return found;
  }
  context.report(diag::NotAValue, context.tree().loc(node.base),
                 {string(context, nameOf(context, node.base)), kindName(context.symbols.pou(block).kind)});
  return Entity::of(EntityKind::Error, 0);
}

// Of a name that was reported: who reads it says nothing more.
TypeId unknown(Meaning& known) {
  known.entity = Entity::of(EntityKind::Error, 0);
  return known.type = types::kError;
}

TypeId checkWhole(Context& context, ExprId& expr, Entity qualifier, Access access) {
  MemberExpr& node = context.code().as<MemberExpr>(expr);
  Meaning& known = meaning(node.h);
  Entity found;
  TypeId record;
  if (qualifier.entityKind() == EntityKind::Pou && isBlockType(context, PouId{qualifier.index})) {
    found = constantOfBlock(context, PouId{qualifier.index}, node);
  } else if (qualifier.entityKind() == EntityKind::Pou) {
    const PouId pou{qualifier.index};
    resolvePou(context, pou);
    record = context.symbols.pou(pou).record;
  } else if (qualifier.entityKind() == EntityKind::Program) {
    const PouId pou = context.project.instances[qualifier.index].program;
    resolvePou(context, pou);
    record = context.symbols.pou(pou).record;
  } else {
    found = lookUpIn(context, qualifier, node.member);
  }
  if (record) {
    if (const VarId var = findMember(context, record, node.member)) {
      found = Entity::of(EntityKind::Var, var.index);
      if (!checkOutsideAccess(context, node, var, access)) found = Entity::of(EntityKind::Error, 0);
    }
    if (!found) {
      if (const auto type = checkObjectMember(context, expr, pouOf(context, record), access)) return *type;
    }
  }
  const bool is_unknown_type = qualifier.entityKind() == EntityKind::Type &&
                               context.types().resolve(TypeId{qualifier.index}) == types::kError;  // reported there
  if (!found) {
    if (!is_unknown_type && (!record || isFirstReportOfMember(context, record, node.member)))
      context
          .report(diag::UnknownMember, node.h.loc,
                  {string(context, nameOf(context, node.base)), string(context, node.member)})
          .didYouMean(record ? nearestField(context, record, node.member) : nearestIn(context, qualifier, node.member));
    return unknown(known);
  }
  if (qualifier.entityKind() == EntityKind::Namespace && !checkVisible(context, found, node.h.loc))
    found = Entity::of(EntityKind::Error, 0);
  known.entity = found;
  return useEntity(context, expr, found, node.h.loc, node.member, access, false);
}

}  // namespace

void markAccess(Context& context, VarId id, Access access, Loc loc) {
  noteMention(context, entity(id), loc, access);
  if (access == Access::Qualifier) return;
  for (VarId at = id; at; at = context.symbols.var(at).external) {
    Var& var = context.symbols.var(at);
    if (reads(access)) ++var.used.reads;
    if (access == Access::Read) continue;
    ++var.used.writes;
    if (takesAddress(access) || !context.body || !var.name || var.external) continue;
    const bool outside = var.storage == Storage::Global || var.storage == Storage::Image;
    auto& writes = context.project.global_writes;
    const auto known = [&] { return !writes.empty() && writes.back().pou == context.pou && writes.back().var == at; };
    if (outside && !known()) writes.push_back({context.pou, at});
  }
}

Entity entityOf(const Context& context, ExprId expr) {
  const Tree& tree = context.tree();
  const ExprKind kind = tree.kind(expr);
  if (kind == ExprKind::Name) return meaning(tree, expr).entity;
  if (kind == ExprKind::TypedName) return meaning(tree, expr).entity;
  if (kind == ExprKind::Member) return meaning(tree, expr).entity;
  return {};
}

VarId enoMemoryOf(const Context& context, ExprId instance) {
  const Entity entity = entityOf(context, instance);
  if (entity.entityKind() != EntityKind::Var) return {};
  VarId var{entity.index};
  if (context.symbols.var(var).external) var = context.symbols.var(var).external;
  return context.symbols.var(var).memory.eno;
}

bool isWhole(const Context& context, const MemberExpr& node) {
  return !context.type(node.base) && entityOf(context, node.base);
}

// `state := Start` with a method Start, and in this method, where Start is a result of another type: as a value of an
// enumeration only its item can be meant.
static bool isMember(const Context& context, Entity entity, TypeId wanted) {
  if (entity.entityKind() == EntityKind::Pou) return static_cast<bool>(context.symbols.pous[entity.index].owner);
  if (entity.entityKind() != EntityKind::Var || !context.pou) return false;
  const Pou& pou = context.symbols.pou(context.pou);
  return pou.owner && pou.result_var == VarId{entity.index} && context.types().resolve(pou.result) != wanted;
}

// Forbids the bare name of a variable whose list is {attribute 'qualified_only'}. CODESYS, "Attribute qualified_only".
//   passes  n := GVL.limit;      fails  n := limit;      E0255
static bool reportQualifiedGlobal(Context& context, NameId name, Loc loc) {
  const NameId key = keyOf(context, name);
  for (size_t i = 0; i < context.scopes.lists.size() && i < context.symbols.global_lists.size(); ++i) {
    const GlobalList& list = context.symbols.global_lists[i];
    if (!list.qualified_only || !list.name || !context.scopes.lists[i].names.find(key)) continue;
    context.report(diag::QualifiedGlobal, loc, {string(context, name), string(context, list.name)})
        .insert(loc, toString(context, list.name) + ".", Sureness::Sure);
    return true;
  }
  return false;
}

Entity resolveName(Context& context, const NameExpr& written, TypeId expected) {
  const NameId name = written.name;
  const Loc loc = written.h.loc;
  Entity entity = lookUp(context, written, loc);
  const TypeId wanted = expected ? context.types().resolve(expected) : expected;
  const bool several = isAmbiguousItem(context, entity);
  if (wanted && context.types().info(wanted).kind == TypeKind::Enum) {
    const bool other_item = entity.entityKind() == EntityKind::EnumValue &&
                            context.types().resolve(context.symbols.enum_values[entity.index].type) != wanted;
    if (!entity || other_item || isMember(context, entity, wanted)) {
      if (const Entity item = lookUpIn(context, Entity::of(EntityKind::Type, wanted.index), name)) entity = item;
    }
  }
  if (entity) {
    const bool decided = wanted && entity.entityKind() == EntityKind::EnumValue &&
                         context.types().resolve(context.symbols.enum_values[entity.index].type) == wanted;
    // iec: a value of two enumerations always needs its type. ed. 3, 6.4.4.3; ed. 2, 2.3.3.1.
    if ((!context.profile().items_by_wanted_type && several && entity.entityKind() == EntityKind::EnumValue) ||
        (!decided && isAmbiguousItem(context, entity))) {
      const TypeId type = context.symbols.enum_values[entity.index].type;
      context.report(diag::AmbiguousItem, loc, {string(context, name), context.types().toString(type)})
          .insert(loc, context.types().toString(type) + "#", Sureness::Proposal);
      return Entity::of(EntityKind::Error, 0);
    }
    return entity;
  }
  if (isFirstReport(context, name) && !reportQualifiedGlobal(context, name, loc))
    addDeclarations(
        context, context.report(diag::UnknownName, loc, {string(context, name)}).didYouMean(nearestName(context, name)),
        name, expected);
  return Entity::of(EntityKind::Error, 0);
}

static bool isSharedGlobal(const Context& context, Entity entity) {
  return entity.entityKind() == EntityKind::Var && context.symbols.vars[entity.index].list &&
         !context.symbols.vars[entity.index].external;
}

TypeId checkName(Context& context, ExprId& expr, TypeId expected, Access access) {
  NameExpr& node = context.code().as<NameExpr>(expr);
  Meaning& known = meaning(node.h);
  known.entity = resolveName(context, node, expected);
  if (isSharedGlobal(context, known.entity) && differsByResource(context, keyOf(context, node.name))) {
    if (isFirstReport(context, node.name))
      context.report(diag::GlobalDiffers, node.h.loc, {string(context, node.name)});
    known.entity = Entity::of(EntityKind::Error, 0);
  }
  if (known.entity.entityKind() == EntityKind::Pou && known.entity.index == context.pou.index) {
    // The name of a function is its result inside its body.
    if (const VarId result = context.symbols.pou(context.pou).result_var) {
      known.entity = Entity::of(EntityKind::Var, result.index);
    }
  }
  if (known.entity.entityKind() == EntityKind::Var && context.symbols.vars[known.entity.index].temporary != 0)
    temporaryType(context, VarId{known.entity.index}, expected);
  return useEntity(context, expr, known.entity, node.h.loc, node.name, access, true);
}

TypeId checkTypedName(Context& context, ExprId& expr) {
  TypedNameExpr& node = context.code().as<TypedNameExpr>(expr);
  Meaning& known = meaning(node.h);
  Entity type = lookUp(context, node.type_name.name, node.type_name.loc);
  if (type.entityKind() == EntityKind::Var) {  // `mode : Mode; … Mode#Idle`: before `#` no variable hides the type
    if (const TypeId hidden = lookUpType(context, node.type_name.name))
      type = Entity::of(EntityKind::Type, hidden.index);
  }
  if (type.entityKind() != EntityKind::Type) {
    known.entity = Entity::of(EntityKind::Error, 0);
    if (!type && !context.types().elementary(node.type_name.name)) {
      if (isFirstReport(context, node.type_name.name))
        context.report(diag::UnknownName, node.type_name.loc, {string(context, node.type_name.name)})
            .didYouMean(nearestName(context, node.type_name.name));
    } else {
      context.report(diag::NotAnEnumeration, node.type_name.loc, {string(context, node.type_name.name)});
    }
    return known.type = types::kError;
  }
  const TypeId enumeration = context.types().resolve(TypeId{type.index});
  if (context.types().info(enumeration).kind != TypeKind::Enum) {
    known.entity = Entity::of(EntityKind::Error, 0);
    if (enumeration != types::kError) {
      context.report(diag::NotAnEnumeration, node.type_name.loc, {string(context, node.type_name.name)});
    }
    return known.type = types::kError;
  }
  known.entity = lookUpIn(context, Entity::of(EntityKind::Type, enumeration.index), node.item.name);
  if (known.entity.entityKind() != EntityKind::EnumValue) {
    if (isFirstReportOfMember(context, enumeration, node.item.name))
      context
          .report(diag::UnknownMember, node.item.loc,
                  {string(context, node.type_name.name), string(context, node.item.name)})
          .didYouMean(nearestField(context, enumeration, node.item.name));
    return unknown(known);
  }
  noteName(context, type, node.type_name.loc);
  noteMention(context, known.entity, node.item.loc, Access::Read);
  known.is_constant = 1;
  return known.type = context.symbols.enum_values[known.entity.index].type;
}

// `phase : Phase; … Phase.Idle`: where the variable has no such member, the name means the enumeration that the
// variable hides. None when it hides none with this item. IEC 61131-3 ed. 3 writes `Phase#Idle`.
Entity hiddenEnumeration(Context& context, const MemberExpr& node, TypeId base) {
  if (context.tree().kind(node.base) != ExprKind::Name) return {};
  const TypeId record = context.types().resolve(base);
  if (context.types().info(record).kind == TypeKind::Record && findMember(context, record, node.member)) return {};
  const TypeId hidden = lookUpType(context, context.tree().as<NameExpr>(node.base).name);
  if (!hidden || context.types().info(context.types().resolve(hidden)).kind != TypeKind::Enum) return {};
  const Entity type = Entity::of(EntityKind::Type, context.types().resolve(hidden).index);
  return lookUpIn(context, type, node.member).entityKind() == EntityKind::EnumValue ? type : Entity{};
}

// `status.kReady` with a constant kReady is that bit of an integer or bit string; none for other members. codesys.
//   passes  VAR CONSTANT kReady : INT := 3; END_VAR  status.kReady := TRUE;
//   fails   VAR ready : INT := 3; END_VAR            status.ready := TRUE;       E0591
std::optional<TypeId> checkNamedBit(Context& context, ExprId& expr, TypeId base) {
  MemberExpr& node = context.code().as<MemberExpr>(expr);
  Meaning& known = meaning(node.h);
  const TypeKind kind = context.types().plainKind(base);
  if (!types::TypeTable::isInteger(kind) && !types::TypeTable::isBits(kind)) return std::nullopt;
  const Entity found = lookUp(context, node.member);
  if (found.entityKind() != EntityKind::Var) return std::nullopt;
  VarId id{found.index};
  if (context.symbols.var(id).external) id = context.symbols.var(id).external;
  ensureVarType(context, id);
  const Var& var = context.symbols.var(id);
  if (var.type == types::kError) return known.type = types::kError;
  const TypeKind index = context.types().plainKind(var.type);
  if (!types::TypeTable::isInteger(index) && !types::TypeTable::isBits(index)) return std::nullopt;
  unknown(known);
  if (!context.profile().named_bits) {
    context.report(diag::NamedBitExtension, node.h.loc);
    return types::kError;
  }
  if (var.constant) ensureInitialValue(context, id);
  markAccess(context, VarId{found.index}, Access::Read, node.h.loc);
  if (!var.constant || !var.has_value) {
    context.report(diag::NamedBitNotConstant, node.h.loc, {string(context, node.member)}).declaredHere(var.loc);
    return types::kError;
  }
  const auto position = static_cast<uint32_t>(std::min<uint64_t>(var.value.bits, 0x7fffffff));
  context.replace(expr, context.build().bitAccess(node.base, position, 1, node.h.loc));
  return checkBitOf(context, expr);
}

// `t.ENO` of a block that declares no such output: ENO of the last call of the instance, kept where the instance has a
// name. IEC 61131-3 ed. 3, 6.6.1.6: ENO is an output of each block.
//   passes  t(EN := go, IN := x, PT := T#1s); ok := t.ENO;
//   fails   timers[i](IN := x, PT := T#1s); ok := timers[i].ENO;       E0272
TypeId checkEno(Context& context, ExprId& expr, PouId block, Access access) {
  MemberExpr& node = context.code().as<MemberExpr>(expr);
  const std::string_view name = string(context, context.symbols.pou(block).name);
  const bool writes =
      access == Access::Write || access == Access::ReadWrite || access == Access::InOut || access == Access::Bind;
  const VarId memory = enoMemoryOf(context, node.base);
  if (!memory || writes) {
    meaning(node.h).entity = Entity::of(EntityKind::Error, 0);
    if (writes)
      context.report(diag::OutputWrittenOutside, node.h.loc, {string(context, node.member), name});
    else
      context.report(diag::EnoNotKept, node.h.loc, {name});
    return meaning(node.h).type = types::kError;
  }
  const NameId hidden = context.symbols.var(memory).name;
  const Loc loc = node.h.loc;
  const bool is_member = context.tree().kind(node.base) == ExprKind::Member;
  const ExprId owner = is_member ? context.tree().as<MemberExpr>(node.base).base : ExprId{};
  context.replace(expr, is_member ? makeMember(context, owner, hidden, entity(memory), loc)
                                  : makeName(context, hidden, entity(memory), loc));
  return useVar(context, expr, memory, access);
}

// `color.Red` where the variable `color` hides the enumeration.
static TypeId checkHiddenItem(Context& context, ExprId& expr, TypeId base, Entity hidden, Access access) {
  const MemberExpr& node = context.tree().as<MemberExpr>(expr);
  if (context.profile().hidden_enumerations) {
    Meaning& qualifier = context.meaning(node.base);
    qualifier.entity = hidden;
    qualifier.type = {};
    noteNameInstead(context, hidden, context.tree().loc(node.base));
    return checkWhole(context, expr, hidden, access);
  }
  const std::string typed = toString(context, nameOf(context, node.base)) + "#" + toString(context, node.member);
  context.report(diag::NotARecord, node.h.loc, {string(context, node.member), context.types().toString(base)})
      .didYouMean(typed, context.tree().begin(node.base), node.h.end);
  return unknown(meaning(node.h));
}

// `base.member` of what has no members: a bit with a name, or a mistake.
static TypeId checkMemberOfValue(Context& context, ExprId& expr, TypeId base) {
  const TypeId resolved = context.types().resolve(base);
  if (const auto type = checkNamedBit(context, expr, resolved)) return *type;
  const MemberExpr& node = context.tree().as<MemberExpr>(expr);
  if (context.types().kind(resolved) == TypeKind::Pointer)
    context.report(diag::MemberOfPointer, node.h.loc, {string(context, node.member)})
        .insert(context.tree().expr(node.base).end, "^", Sureness::Sure);
  else
    context.report(diag::NotARecord, node.h.loc, {string(context, node.member), context.types().toString(base)});
  return unknown(meaning(node.h));
}

TypeId checkMember(Context& context, ExprId& expr, TypeId, Access access) {
  MemberExpr& node = context.code().as<MemberExpr>(expr);
  Meaning& known = meaning(node.h);
  TypeId base = checkBase(context, node.base, access);
  base = throughObject(context, node.base, base);
  if (!base) return checkWhole(context, expr, entityOf(context, node.base), access);
  if (base == types::kError) return known.type = types::kError;
  if (const Entity hidden = hiddenEnumeration(context, node, base))
    return checkHiddenItem(context, expr, base, hidden, access);
  const TypeId record = context.types().resolve(base);
  if (context.types().kind(record) != TypeKind::Record) return checkMemberOfValue(context, expr, base);
  const PouId object = pouOf(context, record);
  const VarId member = findMember(context, record, node.member);
  if (!member && object) {
    if (const auto type = checkObjectMember(context, expr, object, access)) return *type;
  }
  // In edition 4 a block of edition 2 has methods, one with the name of a pin: SEMA.RELEASE(). It is meant.
  if (member && object && access == Access::Qualifier && context.symbols.pou(object).library) {
    for (const PouId method : context.symbols.pou(object).members) {
      if (context.names().same(context.symbols.pou(method).name, node.member))
        return *checkObjectMember(context, expr, object, access, method);
    }
  }
  const bool is_block = object && context.symbols.pou(object).kind == PouKind::FunctionBlock;
  if (!member && is_block && isNamed(context, node.member, kEnableOutput))
    return checkEno(context, expr, object, access);
  if (!member) {
    if (isFirstReportOfMember(context, record, node.member))
      context.report(diag::UnknownMember, node.h.loc, {context.types().toString(base), string(context, node.member)})
          .didYouMean(nearestField(context, record, node.member));
    return unknown(known);
  }
  known.entity = Entity::of(EntityKind::Var, member.index);
  if (!checkOutsideAccess(context, node, member, access)) return known.type = types::kError;
  const TypeId type = useVar(context, expr, member, access);
  return type;
}

}  // namespace rung::sema
