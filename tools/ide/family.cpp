// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/family.h"

#include <algorithm>

namespace rung::ide {

Family::Family(const Scope& scope, Entity member) : scope_(scope), project_(scope.project()) {
  if (member.entityKind() == EntityKind::Type)
    if (const PouId block = scope.blockOf({member.index})) member = Entity::of(EntityKind::Pou, block.index);
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
}

void Family::add(Entity entity) {
  if (declarations_.insert(scope_.locOf(entity).offset).second) members_.push_back(entity);
}

bool Family::has(Entity entity) const {
  const Loc loc = scope_.locOf(entity);
  return loc && declarations_.count(loc.offset) != 0;
}

// A global with each VAR_EXTERNAL that names it.
void Family::addVar(VarId var) {
  for (VarId at = project_.var(var).external; at; at = project_.var(at).external) var = at;
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
