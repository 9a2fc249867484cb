// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/family.h"

#include <algorithm>

namespace rung::ide {

Family::Family(const Scope& scope, Entity member) : scope_(scope), project_(scope.project()) {
  member = namesake(member);
  name_ = scope.nameOf(member);
  if (!name_ || !scope.locOf(member)) return;
  if (member.entityKind() == EntityKind::Var)
    addVar({member.index});
  else
    add(member);
  PouId owner;
  if (member.entityKind() == EntityKind::Pou) owner = project_.pous[member.index].owner;
  if (member.entityKind() == EntityKind::Property) owner = project_.properties[member.index].owner;
  if (owner) addRelatives(owner);
  for (size_t i = 0; i < members_.size(); ++i)
    if (members_[i].entityKind() == EntityKind::Property) addValues(project_.properties[members_[i].index]);
}

// The block of a type; the function of its result; the property of what its accessors get and give.
Entity Family::namesake(Entity member) const {
  if (member.entityKind() == EntityKind::Type)
    if (const PouId block = scope_.blockOf({member.index})) return Entity::of(EntityKind::Pou, block.index);
  if (member.entityKind() != EntityKind::Var) return member;
  const sema::Var& var = project_.vars[member.index];
  const Entity declared = var.pou ? scope_.declaredEntity(var.pou) : Entity{};
  const bool is_result = var.pou && project_.pou(var.pou).result_var == VarId{member.index};
  const bool is_value =
      declared.entityKind() == EntityKind::Property && project_.names.same(scope_.nameOf(declared), var.name);
  return is_result || is_value ? declared : member;
}

void Family::addValues(const sema::Property& property) {
  for (const PouId accessor : {property.get, property.set}) {
    if (!accessor) continue;
    const sema::Pou& pou = project_.pou(accessor);
    if (pou.result_var) add(Entity::of(EntityKind::Var, pou.result_var.index));
    for (const VarId pin : scope_.pinsOf(accessor))
      if (project_.names.same(project_.var(pin).name, name_)) add(Entity::of(EntityKind::Var, pin.index));
  }
}

void Family::add(Entity entity) {
  if (declarations_.insert(scope_.locOf(entity).offset).second) members_.push_back(entity);
}

bool Family::has(Entity entity) const {
  const Loc loc = scope_.locOf(entity);
  return loc && declarations_.count(loc.offset) != 0;
}

void Family::addVar(VarId var) {
  for (VarId at = project_.var(var).external; at; at = project_.var(at).external) var = at;
  addGlobal(var);
  for (const sema::ResourceGlobals& globals : project_.resource_globals)
    if (std::any_of(globals.all.begin(), globals.all.end(), [&](const auto& own) { return own.var == var; }))
      for (const sema::ResourceGlobals::Own& own : globals.all) addGlobal(own.var);
  if (!scope_.isPin(var)) return;
  if (project_.pou(project_.var(var).pou).owner)
    addPins(var);
  else
    addPinsOfMocks(var);
}

// {replaces 'Pump'}: a mock has the pins of what it replaces.
void Family::addPinsOfMocks(VarId var) {
  const auto originalOf = [&](PouId pou) {
    const NameId replaced = project_.pou(pou).pragmas.replaces;
    const Entity found = replaced ? scope_.typeNamed(project_.names.key(replaced)) : Entity{};
    return found.entityKind() == EntityKind::Pou ? PouId{found.index} : pou;
  };
  const PouId original = originalOf(project_.var(var).pou);
  for (uint32_t i = 1; i < project_.pous.size(); ++i) {
    if (originalOf({i}) != original) continue;
    for (const VarId pin : scope_.pinsOf({i}))
      if (project_.names.same(project_.var(pin).name, name_)) add(Entity::of(EntityKind::Var, pin.index));
  }
}

// The pins of a method have the names of those that it overrides.
void Family::addPins(VarId var) {
  const Family methods(scope_, Entity::of(EntityKind::Pou, project_.var(var).pou.index));
  for (const Entity method : methods.members())
    if (method.entityKind() == EntityKind::Pou)
      for (const VarId pin : scope_.pinsOf({method.index}))
        if (project_.names.same(project_.var(pin).name, name_)) add(Entity::of(EntityKind::Var, pin.index));
}

// With each VAR_EXTERNAL that names it.
void Family::addGlobal(VarId var) {
  add(Entity::of(EntityKind::Var, var.index));
  for (uint32_t i = 1; i < project_.vars.size(); ++i)
    if (project_.vars[i].external == var) add(Entity::of(EntityKind::Var, i));
}

// ---- methods, actions and properties

Entity Family::memberNamed(PouId object) const {
  const auto is_named = [&](NameId name) { return project_.names.same(name, name_); };
  for (const uint32_t property : project_.pou(object).object.properties)
    if (is_named(project_.properties[property].name)) return Entity::of(EntityKind::Property, property);
  for (const PouId member : project_.pou(object).members)
    if (is_named(project_.pou(member).name) && project_.pou(member).object.accessor == sema::AccessorKind::None)
      return Entity::of(EntityKind::Pou, member.index);
  return {};
}

void Family::collectAncestors(PouId object, std::vector<PouId>& out) const {
  if (std::find(out.begin(), out.end(), object) != out.end()) return;
  out.push_back(object);
  const sema::Pou& pou = project_.pou(object);
  if (pou.base) collectAncestors(pou.base, out);
  for (const PouId interface : pou.object.interfaces) collectAncestors(interface, out);
}

// An object sees one member of a name in all that it is derived from: those of its line belong together. One that joins
// two lines, a block with two interfaces, makes them one family.
void Family::addRelatives(PouId owner) {
  std::vector<std::vector<PouId>> lines;
  for (uint32_t i = 1; i < project_.pous.size(); ++i) {
    const sema::Pou& pou = project_.pous[i];
    if (pou.instance.of || pou.owner || (!pou.base && pou.object.interfaces.empty())) continue;
    std::vector<PouId> line;
    collectAncestors({i}, line);
    std::erase_if(line, [&](PouId object) { return !memberNamed(object); });
    if (line.size() > 1) lines.push_back(std::move(line));
  }
  std::vector<PouId> related{owner};
  for (size_t known = 0; known != related.size();) {
    known = related.size();
    std::erase_if(lines, [&](const std::vector<PouId>& line) {
      const bool joins = std::find_first_of(line.begin(), line.end(), related.begin(), related.end()) != line.end();
      if (joins) related.insert(related.end(), line.begin(), line.end());
      return joins;
    });
  }
  for (const PouId object : related)
    if (const Entity member = memberNamed(object)) add(member);
}

}  // namespace rung::ide
