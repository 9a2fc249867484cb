// SPDX-License-Identifier: Apache-2.0
// What is declared in a checked project, by name and by place. In: the tables of sema, whose own look-ups end with the
// check. Out: the entity of a name as seen from a POU, the members of a type, everything that is visible. For names
// that the check has not resolved: in lines that are not finished, and in lists of what could be written.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "frontend/source/function_ref.h"
#include "sema/project.h"

namespace rung::ide {

using sema::Entity;
using sema::EntityKind;
using sema::PouId;
using sema::VarId;

class Scope {
 public:
  using Visit = FunctionRef<void(NameId name, Entity entity)>;

  explicit Scope(const sema::Project& project);

  const sema::Project& project() const { return project_; }

  // ---- by place
  PouId pouOf(DeclId declaration) const;
  Entity declaredAt(Loc name) const;
  // The POU; of an accessor its property.
  Entity declaredEntity(PouId pou) const;
  // The name in the declaration of an entity; none: nowhere in the sources.
  Loc locOf(Entity entity) const;
  NameId nameOf(Entity entity) const;

  // ---- by name; `key` is that of Names
  Entity lookUp(PouId from, NameId key) const;
  Entity memberOf(Entity of, NameId key) const;
  Entity memberOf(TypeId type, NameId key) const;
  // A type or block.
  Entity typeNamed(NameId key) const;

  // ---- lists; a name that hides another comes before it
  void visible(PouId from, Visit visit) const;
  void membersOf(Entity of, Visit visit) const;
  void membersOf(TypeId type, Visit visit) const;
  // Input, in-out or output.
  bool isPin(VarId var) const;
  // Those of a POU, those of its bases first.
  std::vector<VarId> pinsOf(PouId pou) const;

  // ---- types
  // Of a value, or what a block, program or function gives.
  TypeId typeOf(Entity entity) const;
  // Through aliases, pointers and references: what has members.
  TypeId recordOf(TypeId type) const;
  PouId blockOf(TypeId type) const;
  bool hasMembers(TypeId type) const;

 private:
  template <class Id>
  using ByKey = std::vector<Id>;  // by the index of what is known to be small in number: a name, a type
  // The things of each type, in order.
  struct OfTypes {
    std::vector<uint32_t> begin;  // by type, and the end
    std::vector<uint32_t> all;
    std::span<const uint32_t> of(uint32_t type) const;
  };
  template <class TypeOf>
  OfTypes ofTypes(uint32_t count, TypeOf typeOf) const;

  void addPous();
  void addVars();
  void addGlobals();
  void addTypes();
  void list(NameId name, Entity entity);
  void findPlaces() const;
  NameId keyOf(NameId name) const { return project_.names.key(name); }
  uint32_t placeOf(Loc loc) const;
  void membersOfPou(PouId pou, bool with_locals, Visit visit) const;

  const sema::Project& project_;
  std::unordered_map<uint32_t, PouId> pous_;             // by where the declaration begins
  mutable std::unordered_map<uint32_t, Entity> places_;  // by the offset of the declared name; made when asked for
  ByKey<Entity> globals_;                                // by name: visible in the whole project
  ByKey<Entity> types_;                                  // by name: types and blocks
  ByKey<PouId> blocks_;                                  // by the type of their instances
  std::unordered_map<uint32_t, uint32_t> properties_;    // by accessor
  OfTypes fields_;                                       // of structures: vars
  OfTypes items_;                                        // of enumerations: enum_values
  std::vector<std::pair<NameId, Entity>> listed_;        // all globals, in order
};

}  // namespace rung::ide
