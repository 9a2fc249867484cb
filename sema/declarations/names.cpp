// SPDX-License-Identifier: Apache-2.0
// Name lookup: the meaning of a name at a location, members of records, the name nearest to a misspelled one.
#include "sema/declarations/names.h"

#include <algorithm>
#include <vector>

#include "sema/declarations/libraries.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/namespaces.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

bool NameMap::insert(NameId key, Entity entity) {
  if ((count_ + 1) * 4 > slots_.size() * 3) {
    std::vector<Slot> old(slots_.empty() ? 8 : slots_.size() * 2);
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (!slot.key) continue;
      uint32_t i = hash(slot.key);
      while (slots_[i & (slots_.size() - 1)].key) ++i;
      slots_[i & (slots_.size() - 1)] = slot;
    }
  }
  for (uint32_t i = hash(key);; ++i) {
    Slot& slot = slots_[i & (slots_.size() - 1)];
    if (slot.key == key) return false;
    if (slot.key) continue;
    slot = {key, entity};
    ++count_;
    return true;
  }
}

namespace {

// An entity that is found must be usable at once: its type resolved, its value known when it is constant.
Entity ready(Context& context, Entity found) {
  switch (found.entityKind()) {
    case EntityKind::Var: {
      const VarId id{found.index};
      ensureVarType(context, id);
      if (context.symbols.var(id).constant) ensureInitialValue(context, id);
      break;
    }
    case EntityKind::EnumValue: resolveNamed(context, context.symbols.enum_values[found.index].type); break;
    case EntityKind::Type: resolveNamed(context, TypeId{found.index}); break;
    case EntityKind::Pou: resolvePou(context, PouId{found.index}); break;
    case EntityKind::Property: {
      const Property& property = context.symbols.properties[found.index];
      for (const PouId accessor : {property.get, property.set})
        if (accessor) resolvePou(context, accessor);
      break;
    }
    case EntityKind::None:
    case EntityKind::Error:
    case EntityKind::GlobalList:
    case EntityKind::Namespace:
    case EntityKind::Program: break;
  }
  return found;
}

// An item of the enumeration that is being declared, when its value is known already.
Entity findOwnItem(Context& context, NameId key) {
  const NamedType& named = *context.scopes.named(context.items_of);
  const Entity found = named.members.find(key);
  if (!found || named.resolved == State::Done) return found;
  const auto& items = context.types().info(context.items_of).items;
  if (items.empty()) return {};
  const Entity first = named.members.find(keyOf(context, items[0].first));
  const bool known = uint32_t{found.index} - uint32_t{first.index} < items.size();
  return known ? found : Entity{};
}

// Of several program instances with one name, that of the resource.
Entity instanceOfResource(const Context& context, NameId key, Entity found) {
  if (found.entityKind() != EntityKind::Program || !context.resource) return found;
  const auto& instances = context.project.instances;
  for (uint32_t i = 0; i < instances.size(); ++i) {
    if (keyOf(context, instances[i].name) == key && instances[i].resource &&
        keyOf(context, instances[i].resource) == context.resource)
      return Entity::of(EntityKind::Program, i);
  }
  return found;
}

// A block or type is not a value, so in an expression the name is that of the global variable: Trace : Trace. But where
// no variable hides an enumeration, `Color.Red` is an item of it.
bool givesWay(Context& context, Entity found) {
  if (found.entityKind() == EntityKind::Pou) {
    const PouKind kind = context.symbols.pous[found.index].kind;
    return kind == PouKind::FunctionBlock || kind == PouKind::Class || kind == PouKind::Interface;
  }
  if (found.entityKind() != EntityKind::Type) return false;
  if (context.profile().hidden_enumerations) return true;
  resolveNamed(context, TypeId{found.index});
  return context.types().plainKind(TypeId{found.index}) != types::TypeKind::Enum;
}

// An entity of the project, its namespaces or the libraries.
Entity findDeclared(Context& context, NameId key, Loc loc) {
  Scopes& scopes = context.scopes;
  if (context.region)
    if (const Entity found = lookUpAround(context, key, loc, false)) return found;
  if (const Entity found = scopes.pous_and_types.find(key)) {
    if (const Entity global = givesWay(context, found) ? scopes.globals.find(key) : Entity{})
      return globalOfResource(context, key, global);
    return found;
  }
  if (const Entity found = scopes.globals.find(key)) return globalOfResource(context, key, found);
  if (const Entity found = scopes.items.find(key)) return found;
  if (const Entity found = scopes.namespaces.find(key)) return found;
  if (const Entity found = scopes.qualifiers.find(key)) return instanceOfResource(context, key, found);
  if (context.region)
    if (const Entity found = lookUpOpened(context, key, loc, false)) return found;
  if (!context.library) {
    if (const Entity found = lookUpLibrary(context, key)) return found;
  }
  return scopes.libraries.namespaces.find(key);
}

Entity findName(Context& context, NameId key, Loc loc) {
  Scopes& scopes = context.scopes;
  if (context.items_of) {
    if (const Entity found = findOwnItem(context, key)) return found;
  }
  if (context.pou) {
    if (const Entity found = scopes.pous[context.pou.index].names.find(key)) return found;
    const Pou& pou = context.symbols.pou(context.pou);
    for (PouId chart = pou.chart; chart; chart = context.symbols.pou(chart).chart) {
      const Entity found = scopes.pous[chart.index].names.find(key);
      const bool local = found.entityKind() == EntityKind::Var && context.symbols.vars[found.index].pou == chart;
      if (found && !local) return found;
    }
    if (const PouId object = objectOf(context); object && (pou.owner || pou.base)) {
      if (const Entity found = findInObject(context, object, key)) return found;
    }
  }
  if (context.list)
    if (const Entity found = scopes.lists[context.list.index].names.find(key)) return found;
  if (context.library) {  // a library is never captured by names of the project
    if (const Entity found = lookUpLibrary(context, key)) return found;
  }
  return orMock(context, key, findDeclared(context, key, loc));
}

}  // namespace

Entity globalOfResource(const Context& context, NameId key, Entity global) {
  if (!context.resource) return global;
  const Entity family = context.scopes.resource_globals.find(key);
  if (!family) return global;
  return entity(context.project.resource_globals[family.index].of(context.resource));
}

bool differsByResource(Context& context, NameId key) {
  if (context.resource) return false;
  const Entity family = context.scopes.resource_globals.find(key);
  if (!family) return false;
  const ResourceGlobals& globals = context.project.resource_globals[family.index];
  for (const ResourceGlobals::Own& own : globals.all) {
    ensureVarType(context, own.var);
    if (context.symbols.var(own.var).constant) ensureInitialValue(context, own.var);
  }
  const Var& first = context.symbols.var(globals.all.front().var);
  for (const ResourceGlobals::Own& own : globals.all) {
    const Var& var = context.symbols.var(own.var);
    if (context.types().resolve(var.type) != context.types().resolve(first.type)) return true;
    if (var.constant != first.constant || var.has_value != first.has_value) return true;
    if (var.has_value && var.value.bits != first.value.bits) return true;
  }
  return false;
}

Entity orMock(Context& context, NameId key, Entity found) {
  if (context.library || found.entityKind() != EntityKind::Pou) return found;
  for (size_t i = 0; i < context.scopes.mocks.size(); ++i) {
    if (context.scopes.mocks[i].key != key || context.scopes.mocks[i].busy) continue;
    const PouId mock = context.scopes.mocks[i].mock;
    if (mock == context.pou) continue;  // a mock may use the original
    if (!context.scopes.mocks[i].original) {
      context.scopes.mocks[i].busy = true;
      Context there = atPou(context, mock);
      there.pou = {};
      const Entity original = findDotted(there, context.symbols.pou(mock).pragmas.replaces);
      context.scopes.mocks[i].busy = false;
      if (original.entityKind() == EntityKind::Pou) context.scopes.mocks[i].original = PouId{original.index};
    }
    if (context.scopes.mocks[i].original.index == found.index) return entity(mock);
  }
  return found;
}

Entity findDotted(Context& context, NameId dotted) {
  const std::string name(context.names().string(dotted));
  Entity found;
  for (size_t at = 0; at <= name.size();) {
    const size_t end = std::min(name.find('.', at), name.size());
    const NameId part = context.names().intern(std::string_view(name).substr(at, end - at));
    if (at != 0)
      found = found.entityKind() == EntityKind::Namespace ? lookUpNamespace(context, found.index, keyOf(context, part))
                                                          : Entity{};
    else
      found = end < name.size() ? findNamespace(context, part) : findName(context, keyOf(context, part), {});
    at = end + 1;
  }
  return found;
}

Entity lookUp(Context& context, NameId name, Loc loc) {
  return ready(context, findName(context, keyOf(context, name), loc));
}

Entity lookUp(Context& context, const NameExpr& name, Loc loc) {
  if (name.h.op != kGlobalName) return lookUp(context, name.name, loc);
  Context outside = context;
  outside.pou = {};
  outside.list = {};
  outside.items_of = {};
  return lookUp(outside, name.name, loc);
}

bool isAmbiguousItem(Context& context, Entity item) {
  return item.entityKind() == EntityKind::EnumValue && item.index < context.scopes.item_is_ambiguous.size() &&
         context.scopes.item_is_ambiguous[item.index];
}

Entity lookUpIn(Context& context, Entity qualifier, NameId name) {
  const NameId key = keyOf(context, name);
  Scopes& scopes = context.scopes;
  switch (qualifier.entityKind()) {
    case EntityKind::GlobalList: return ready(context, scopes.lists[qualifier.index].names.find(key));
    case EntityKind::Namespace: {
      return ready(context, orMock(context, key, lookUpNamespace(context, qualifier.index, key)));
    }
    case EntityKind::Type: {
      resolveNamed(context, TypeId{qualifier.index});
      const TypeId type = context.types().resolve(TypeId{qualifier.index});
      resolveNamed(context, type);
      if (context.types().info(type).kind != types::TypeKind::Enum) return {};
      NamedType* named = scopes.named(type);
      return named == nullptr ? Entity{} : named->members.find(key);
    }
    case EntityKind::None:
    case EntityKind::Error:
    case EntityKind::Var:
    case EntityKind::Pou:
    case EntityKind::EnumValue:
    case EntityKind::Property:
    case EntityKind::Program: return {};
  }
  return {};
}

VarId findMember(Context& context, TypeId record, NameId name) {
  const TypeId type = context.types().resolve(record);
  NamedType* named = context.scopes.named(type);
  if (named == nullptr || context.types().info(type).kind != types::TypeKind::Record) return {};
  if (named->pou) return findPin(context, named->pou, name);
  resolveNamed(context, type);
  const Entity found = named->members.find(keyOf(context, name));
  return found.entityKind() == EntityKind::Var ? VarId{found.index} : VarId{};
}

VarId findPin(Context& context, PouId pou, NameId name) {
  resolvePou(context, pou);
  for (; pou; pou = context.symbols.pou(pou).base) {
    const Entity found = context.scopes.pous[pou.index].names.find(keyOf(context, name));
    if (found.entityKind() != EntityKind::Var) continue;
    const VarId id{found.index};
    if (context.symbols.var(id).pou != pou || id == context.symbols.pou(pou).result_var) continue;
    ensureVarType(context, id);
    return id;
  }
  return {};
}

bool isBroken(const Context& context, PouId id) {
  if (context.scopes.reports_all) return false;
  const DeclId decl = id ? context.symbols.pou(id).decl : DeclId{};
  if (decl && context.tree().as<PouDecl>(decl).is_broken) return true;
  return id && (context.symbols.pou(id).object.unresolved || isBroken(context, context.symbols.pou(id).owner));
}

namespace {

bool firstTime(Context& context, uint32_t where, NameId name) {
  if (context.symbols.diagnostics.full() || context.scopes.reports_all) return true;
  const uint64_t key = uint64_t{where} << 32 | keyOf(context, name).index;
  std::vector<Scopes::Reported>& reported = context.scopes.reported;
  const auto is_same = [&](const Scopes::Reported& known) { return known.key == key; };
  if (std::any_of(reported.begin(), reported.end(), is_same)) return false;
  reported.push_back({key, context.body != nullptr ? context.pou : PouId{}});
  return true;
}

}  // namespace

bool isFirstReport(Context& context, NameId name) {
  const bool is_lost = context.tree().lost_names && !context.scopes.reports_all;
  if (is_lost || isBroken(context, context.pou)) return false;
  return firstTime(context, context.pou.index, name);
}

bool isFirstReportOfMember(Context& context, TypeId record, NameId name) {
  if (context.scopes.reports_all) return true;
  const NamedType* named = context.scopes.named(context.types().resolve(record));
  if (named != nullptr && (isBroken(context, named->pou) || context.tree().lost_names)) return false;
  noteEffect(context);  // another body may name it too
  return firstTime(context, 0x80000000u | record.index, name);
}

namespace {

bool isCallable(const Context& context, Entity found) {
  if (found.entityKind() == EntityKind::Var) {
    const types::TypeInfo& type = context.types().info(context.types().resolve(context.symbols.vars[found.index].type));
    return !types::TypeTable::isElementary(type.kind);
  }
  if (found.entityKind() != EntityKind::Pou) return false;
  const PouKind kind = context.symbols.pous[found.index].kind;
  return kind != PouKind::FunctionBlock && kind != PouKind::Class && kind != PouKind::Interface;
}

std::string_view nearestOf(Context& context, NameId written, bool callable) {
  const bool is_read = !context.symbols.diagnostics.full() && !context.scopes.reports_all;
  if (!is_read) return {};  // the message is not printed, and the search is slow
  if (const std::string_view elsewhere = nameElsewhere(context, keyOf(context, written)); !elsewhere.empty())
    return elsewhere;
  std::vector<std::string_view> candidates;
  const Names& names = context.names();
  const auto add = [&](NameId key, Entity) { candidates.push_back(names.string(key)); };
  const auto addDeclared = [&](NameId key, Entity found) {
    if (callable && !isCallable(context, found)) return;
    NameId spelling = key;
    if (found.entityKind() == EntityKind::Var) spelling = context.symbols.vars[found.index].name;
    if (found.entityKind() == EntityKind::Pou) spelling = context.symbols.pous[found.index].name;
    if (found.entityKind() == EntityKind::Property) spelling = context.symbols.properties[found.index].name;
    if (found.entityKind() == EntityKind::EnumValue) spelling = context.symbols.enum_values[found.index].name;
    if (found.entityKind() == EntityKind::Type) spelling = context.types().info(TypeId{found.index}).name;
    candidates.push_back(names.string(spelling && names.same(spelling, key) ? spelling : key));
  };
  if (context.pou) context.scopes.pous[context.pou.index].names.forEach(addDeclared);
  const PouId object = objectOf(context);
  for (PouId at = object; at; at = context.symbols.pou(at).base)
    if (at != context.pou) context.scopes.pous[at.index].names.forEach(addDeclared);
  if (const Namespace* space = namespaceAround(context); space != nullptr) {
    space->names.forEach(addDeclared);
    space->globals.forEach(addDeclared);
  }
  context.scopes.namespaces.forEach(add);
  context.scopes.pous_and_types.forEach(addDeclared);
  context.scopes.globals.forEach(addDeclared);
  context.scopes.items.forEach(addDeclared);
  context.scopes.qualifiers.forEach([&](NameId key, Entity) {
    const std::string_view name = names.string(key);  // not the lists of VAR_STAT and of literals
    if (!name.ends_with("__static") && !name.ends_with("__texts")) candidates.push_back(name);
  });
  const size_t declared = candidates.size();
  const Libraries& libraries = context.scopes.libraries;
  libraries.index.forEach(
      [&](NameId, Entity entry) { candidates.push_back(names.string(libraries.names[entry.index].name)); });
  while (true) {
    const std::string_view found = nearest(names.string(written), candidates);
    const auto of_library =
        std::find(candidates.begin() + static_cast<std::ptrdiff_t>(declared), candidates.end(), found);
    if (!callable || of_library == candidates.end()) return found;
    if (isCallable(context, lookUpLibrary(context, context.names().intern(found)))) return found;
    candidates.erase(of_library);
  }
}

}  // namespace

std::string_view nearestName(Context& context, NameId written) { return nearestOf(context, written, false); }
std::string_view nearestCallable(Context& context, NameId written) { return nearestOf(context, written, true); }

}  // namespace rung::sema
