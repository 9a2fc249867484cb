// SPDX-License-Identifier: Apache-2.0
// The declarations that share one name and change it together. In: one of them. Out: all of them: a global and its
// VAR_EXTERNALs, a method of an interface and what implements it, an overriding method and the one that it overrides, a
// block and the type of its instances. Asked by references and rename.
#pragma once

#include <unordered_set>
#include <vector>

#include "tools/ide/scope.h"

namespace rung::ide {

class Family {
 public:
  Family(const Scope& scope, Entity member);

  // Also where another entity has the same declaration: a block with generic constants, whose instances are checked.
  bool has(Entity entity) const;
  // In no order; none: the name is not declared in a source.
  const std::vector<Entity>& members() const { return members_; }
  NameId name() const { return name_; }

 private:
  Entity namesake(Entity member) const;
  void add(Entity entity);
  void addValues(const sema::Property& property);
  void addVar(VarId var);
  void addGlobal(VarId var);
  void addPins(VarId var);
  void addPinsOfMocks(VarId var);
  void addRelatives(PouId owner);
  Entity memberNamed(PouId object) const;
  void collectAncestors(PouId object, std::vector<PouId>& out) const;

  const Scope& scope_;
  const sema::Project& project_;
  NameId name_;
  std::vector<Entity> members_;
  std::unordered_set<uint32_t> declarations_;  // the offsets of their names
};

}  // namespace rung::ide
