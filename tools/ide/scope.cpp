// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/scope.h"

#include <algorithm>

namespace rung::ide {
namespace {

constexpr uint32_t kMostBases = 1000;  // a chain that goes on is a circle, which was reported

template <class Table, class Key>
auto found(const Table& table, Key key) -> typename Table::mapped_type {
  const auto entry = table.find(key);
  return entry == table.end() ? typename Table::mapped_type{} : entry->second;
}

template <class Id>
Id at(const std::vector<Id>& list, uint32_t index) {
  return index < list.size() ? list[index] : Id{};
}

// Declared in the source, not made by the compiler.
bool isWritten(const sema::Var& var) { return var.name && var.loc && var.temporary == 0 && !var.sharing.copy_of; }

}  // namespace

Scope::Scope(const sema::Project& project)
    : project_(project),
      globals_(project.names.count()),
      types_(project.names.count()),
      blocks_(project.types.count()) {
  addPous();
  addVars();
  addTypes();
  addGlobals();
}

// ---- tables

std::span<const uint32_t> Scope::OfTypes::of(uint32_t type) const {
  if (type + 1 >= begin.size()) return {};
  return std::span(all).subspan(begin[type], begin[type + 1] - begin[type]);
}

// Of the things 1 to `count` those that `typeOf` gives a type.
template <class TypeOf>
Scope::OfTypes Scope::ofTypes(uint32_t count, TypeOf typeOf) const {
  OfTypes out;
  out.begin.resize(project_.types.count() + 1);
  for (uint32_t i = 1; i < count; ++i)
    if (const TypeId type = typeOf(i)) ++out.begin[type.index + 1];
  for (size_t type = 1; type < out.begin.size(); ++type) out.begin[type] += out.begin[type - 1];
  out.all.resize(out.begin.back());
  std::vector<uint32_t> next(out.begin.begin(), out.begin.end() - 1);
  for (uint32_t i = 1; i < count; ++i)
    if (const TypeId type = typeOf(i)) out.all[next[type.index]++] = i;
  return out;
}

void Scope::addPous() {
  for (uint32_t i = 1; i < project_.pous.size(); ++i) {
    const sema::Pou& pou = project_.pous[i];
    if (pou.instance.of) continue;
    if (pou.decl) pous_.emplace(placeOf(project_.tree.decl(pou.decl).begin), PouId{i});
    if (pou.record && !blocks_[pou.record.index]) blocks_[pou.record.index] = PouId{i};
  }
  for (uint32_t i = 1; i < project_.properties.size(); ++i)
    for (const PouId accessor : {project_.properties[i].get, project_.properties[i].set})
      if (accessor) properties_.emplace(accessor.index, i);
}

void Scope::addVars() {
  fields_ = ofTypes(static_cast<uint32_t>(project_.vars.size()), [&](uint32_t i) {
    const sema::Var& var = project_.vars[i];
    return isWritten(var) && !var.pou ? var.record : TypeId{};
  });
  items_ = ofTypes(static_cast<uint32_t>(project_.enum_values.size()),
                   [&](uint32_t i) { return project_.enum_values[i].type; });
}

// The first declaration of a place counts.
void Scope::findPlaces() const {
  const auto add = [&](Loc loc, EntityKind kind, uint32_t index) {
    places_.emplace(placeOf(loc), Entity::of(kind, index));
  };
  places_.reserve(project_.vars.size() + project_.pous.size());
  for (uint32_t i = 1; i < project_.pous.size(); ++i) {
    const sema::Pou& pou = project_.pous[i];
    if (!pou.instance.of && pou.loc && pou.object.accessor == sema::AccessorKind::None)
      add(pou.loc, EntityKind::Pou, i);
  }
  for (uint32_t i = 1; i < project_.properties.size(); ++i) add(project_.properties[i].loc, EntityKind::Property, i);
  for (uint32_t i = 0; i < project_.instances.size(); ++i)
    if (project_.instances[i].loc) add(project_.instances[i].loc, EntityKind::Program, i);
  for (uint32_t i = 1; i < project_.vars.size(); ++i)
    if (isWritten(project_.vars[i])) add(project_.vars[i].loc, EntityKind::Var, i);
  for (uint32_t i = 1; i < project_.enum_values.size(); ++i) add(project_.enum_values[i].loc, EntityKind::EnumValue, i);
}

void Scope::list(NameId name, Entity entity) {
  listed_.emplace_back(name, entity);
  if (Entity& known = globals_[keyOf(name).index]; !known) known = entity;
}

void Scope::addTypes() {
  const auto addNamed = [&](NameId name, Entity entity) {
    if (Entity& known = types_[keyOf(name).index]; !known) known = entity;
  };
  for (uint32_t i = 1; i < project_.types.count(); ++i) {
    const types::TypeInfo& info = project_.types.info({i});
    const bool is_named = info.kind == types::TypeKind::Enum || info.kind == types::TypeKind::Subrange ||
                          info.kind == types::TypeKind::Alias || info.kind == types::TypeKind::Record;
    const bool is_structure =
        info.record_kind == types::RecordKind::Struct || info.record_kind == types::RecordKind::Union;
    if (!is_named || !info.name || (info.kind == types::TypeKind::Record && !is_structure)) continue;
    const Entity entity = Entity::of(EntityKind::Type, i);
    addNamed(info.name, entity);
    if (info.shown_name) addNamed(info.shown_name, entity);
    list(info.name, entity);
  }
}

void Scope::addGlobals() {
  for (uint32_t i = 1; i < project_.pous.size(); ++i) {
    const sema::Pou& pou = project_.pous[i];
    if (pou.owner || pou.instance.of || !pou.name) continue;
    const Entity entity = Entity::of(EntityKind::Pou, i);
    list(pou.name, entity);
    if (Entity& known = types_[keyOf(pou.name).index]; !known) known = entity;
  }
  for (uint32_t i = 1; i < project_.global_lists.size(); ++i) {
    const sema::GlobalList& of = project_.global_lists[i];
    if (of.name && project_.names.string(of.name).ends_with("__texts")) continue;  // sema/bodies/literal_storage.h
    if (!of.qualified_only)
      for (const VarId var : of.vars)
        if (isWritten(project_.var(var))) list(project_.var(var).name, Entity::of(EntityKind::Var, var.index));
    if (of.name) list(of.name, Entity::of(EntityKind::GlobalList, i));
  }
  for (uint32_t i = 1; i < project_.enum_values.size(); ++i)
    if (!project_.types.info(project_.enum_values[i].type).qualified)
      list(project_.enum_values[i].name, Entity::of(EntityKind::EnumValue, i));
  for (uint32_t i = 0; i < project_.instances.size(); ++i)
    if (project_.instances[i].name) list(project_.instances[i].name, Entity::of(EntityKind::Program, i));
}

// ---- by place

// What is declared may have been checked in a text of before: sources map it to the one that is edited.
uint32_t Scope::placeOf(Loc loc) const { return project_.sources.current(loc).offset; }

PouId Scope::pouOf(DeclId declaration) const { return found(pous_, placeOf(project_.tree.decl(declaration).begin)); }

Entity Scope::declaredAt(Loc name) const {
  if (places_.empty()) findPlaces();
  return found(places_, placeOf(name));
}

Loc Scope::locOf(Entity entity) const {
  switch (entity.entityKind()) {
    case EntityKind::Var: return project_.vars[entity.index].loc;
    case EntityKind::Pou: return project_.pous[entity.index].loc;
    case EntityKind::EnumValue: return project_.enum_values[entity.index].loc;
    case EntityKind::GlobalList: return project_.global_lists[entity.index].loc;
    case EntityKind::Program: return project_.instances[entity.index].loc;
    case EntityKind::Property: return project_.properties[entity.index].loc;
    case EntityKind::Type: {
      if (const PouId block = blockOf({entity.index})) return project_.pou(block).loc;
      return entity.index < project_.type_locs.size() ? project_.type_locs[entity.index] : Loc{};
    }
    case EntityKind::Namespace:
    case EntityKind::None:
    case EntityKind::Error: break;
  }
  return {};
}

NameId Scope::nameOf(Entity entity) const {
  switch (entity.entityKind()) {
    case EntityKind::Var: return project_.vars[entity.index].name;
    case EntityKind::Pou: return project_.pous[entity.index].name;
    case EntityKind::EnumValue: return project_.enum_values[entity.index].name;
    case EntityKind::GlobalList: return project_.global_lists[entity.index].name;
    case EntityKind::Program: return project_.instances[entity.index].name;
    case EntityKind::Property: return project_.properties[entity.index].name;
    case EntityKind::Type: return project_.types.info({entity.index}).name;
    case EntityKind::Namespace:
    case EntityKind::None:
    case EntityKind::Error: break;
  }
  return {};
}

Entity Scope::declaredEntity(PouId pou) const {
  const uint32_t property = found(properties_, pou.index);
  return property != 0 ? Entity::of(EntityKind::Property, property) : Entity::of(EntityKind::Pou, pou.index);
}

// ---- lists

// Of an object and its bases: pins, properties and methods, and for its own code also the other variables.
void Scope::membersOfPou(PouId pou, bool with_locals, Visit visit) const {
  uint32_t bases = 0;
  for (PouId at = pou; at && bases < kMostBases; at = project_.pou(at).base, ++bases) {
    const sema::Pou& of = project_.pou(at);
    for (const VarId id : of.vars) {
      const sema::Var& var = project_.var(id);
      const bool is_visible =
          with_locals || isPin(id) || of.kind == PouKind::Program || var.access == AccessLevel::Public;
      if (isWritten(var) && is_visible) visit(var.name, Entity::of(EntityKind::Var, id.index));
    }
    for (const uint32_t property : of.object.properties)
      visit(project_.properties[property].name, Entity::of(EntityKind::Property, property));
    for (const PouId member : of.members)
      if (project_.pou(member).object.accessor == sema::AccessorKind::None)
        visit(project_.pou(member).name, Entity::of(EntityKind::Pou, member.index));
    for (const PouId interface : of.object.interfaces)  // EXTENDS of an interface
      if (of.kind == PouKind::Interface && bases == 0) membersOfPou(interface, false, visit);
  }
}

void Scope::membersOf(TypeId type, Visit visit) const {
  const TypeId record = recordOf(type);
  if (const PouId block = blockOf(record)) return membersOfPou(block, false, visit);
  for (const uint32_t field : fields_.of(record.index))
    visit(project_.vars[field].name, Entity::of(EntityKind::Var, field));
}

void Scope::membersOf(Entity of, Visit visit) const {
  switch (of.entityKind()) {
    case EntityKind::GlobalList:
      for (const VarId var : project_.global_lists[of.index].vars)
        if (isWritten(project_.var(var))) visit(project_.var(var).name, Entity::of(EntityKind::Var, var.index));
      return;
    case EntityKind::Type:
      for (const uint32_t item : items_.of(of.index))
        visit(project_.enum_values[item].name, Entity::of(EntityKind::EnumValue, item));
      return;
    case EntityKind::Pou:
      if (project_.pous[of.index].kind == PouKind::Program) return membersOfPou({of.index}, false, visit);
      if (project_.pous[of.index].result) membersOf(project_.pous[of.index].result, visit);
      return;
    case EntityKind::Program: return membersOfPou(project_.instances[of.index].program, false, visit);
    case EntityKind::Var:
    case EntityKind::Property: return membersOf(typeOf(of), visit);
    case EntityKind::EnumValue:
    case EntityKind::Namespace:
    case EntityKind::None:
    case EntityKind::Error: return;
  }
}

void Scope::visible(PouId from, Visit visit) const {
  if (from) {
    const sema::Pou& pou = project_.pou(from);
    if (pou.result_var) visit(pou.name, Entity::of(EntityKind::Var, pou.result_var.index));
    membersOfPou(from, true, visit);
    if (pou.owner) membersOfPou(pou.owner, true, visit);
  }
  for (const auto& [name, entity] : listed_) visit(name, entity);
}

bool Scope::isPin(VarId var) const {
  const SectionKind section = project_.var(var).section;
  return section == SectionKind::Input || section == SectionKind::Output || section == SectionKind::InOut;
}

std::vector<VarId> Scope::pinsOf(PouId pou) const {
  std::vector<PouId> line;
  for (PouId at = pou; at && line.size() < kMostBases; at = project_.pou(at).base) line.push_back(at);
  std::vector<VarId> pins;
  for (auto at = line.rbegin(); at != line.rend(); ++at)
    for (const VarId var : project_.pou(*at).vars)
      if (isPin(var) && isWritten(project_.var(var))) pins.push_back(var);
  return pins;
}

// ---- by name

Entity Scope::lookUp(PouId from, NameId key) const {
  if (!key) return {};
  Entity result;
  if (from) {
    const auto first = [&](NameId name, Entity entity) {
      if (!result && keyOf(name) == key) result = entity;
    };
    const sema::Pou& pou = project_.pou(from);
    if (pou.result_var && keyOf(pou.name) == key) return Entity::of(EntityKind::Var, pou.result_var.index);
    membersOfPou(from, true, first);
    if (!result && pou.owner) membersOfPou(pou.owner, true, first);
  }
  return result ? result : at(globals_, key.index);
}

Entity Scope::memberOf(Entity of, NameId key) const {
  Entity result;
  membersOf(of, [&](NameId name, Entity entity) {
    if (!result && keyOf(name) == key) result = entity;
  });
  return result;
}

Entity Scope::memberOf(TypeId type, NameId key) const {
  Entity result;
  membersOf(type, [&](NameId name, Entity entity) {
    if (!result && keyOf(name) == key) result = entity;
  });
  return result;
}

Entity Scope::typeNamed(NameId key) const { return at(types_, key.index); }

// ---- types

TypeId Scope::typeOf(Entity entity) const {
  switch (entity.entityKind()) {
    case EntityKind::Var: return project_.vars[entity.index].type;
    case EntityKind::EnumValue: return project_.enum_values[entity.index].type;
    case EntityKind::Type: return {entity.index};
    case EntityKind::Pou: {
      const sema::Pou& pou = project_.pous[entity.index];
      return pou.record ? pou.record : pou.result;
    }
    case EntityKind::Program: return project_.pou(project_.instances[entity.index].program).record;
    case EntityKind::Property: {
      const sema::Property& property = project_.properties[entity.index];
      if (property.get) return project_.pou(property.get).result;
      const std::vector<VarId> pins = property.set ? pinsOf(property.set) : std::vector<VarId>();
      return pins.empty() ? TypeId{} : project_.var(pins.front()).type;
    }
    case EntityKind::GlobalList:
    case EntityKind::Namespace:
    case EntityKind::None:
    case EntityKind::Error: break;
  }
  return {};
}

// A variable of an INTERFACE is a pointer in memory, but is written like the object.
TypeId Scope::recordOf(TypeId type) const {
  const types::TypeTable& types = project_.types;
  type = types.resolve(type);
  const TypeId target = types.resolve(types.info(type).base);
  if (types.kind(type) == types::TypeKind::Reference) return target;
  const bool is_object = types.kind(type) == types::TypeKind::Pointer &&
                         types.kind(target) == types::TypeKind::Record &&
                         types.info(target).record_kind == types::RecordKind::Interface;
  return is_object ? target : type;
}

PouId Scope::blockOf(TypeId type) const { return at(blocks_, type.index); }

bool Scope::hasMembers(TypeId type) const {
  const TypeId record = recordOf(type);
  return blockOf(record) || !fields_.of(record.index).empty();
}

}  // namespace rung::ide
