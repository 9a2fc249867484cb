// SPDX-License-Identifier: Apache-2.0
// NAMESPACE and USING: the namespaces of the project, which of them are visible at a location, and the meaning of names
// there. In: the declarations of all files. Out: a Namespace, as for a library, for each NAMESPACE; a Region for each
// piece of source with its own view of names (none in a project without namespaces). POUs and types in a namespace have
// their full name, `Plant.Motor`, which no user's name can be. IEC 61131-3 ed. 3, 6.9, tables 64 to 66.
//
// Lookup goes from the inside out: the declarations of the namespace around the name, then those that the USINGs of
// that block open, then the same for the next outer namespace; at file level the project's names, the USINGs of the
// file, the libraries. A USING opens the declarations of its namespace, not the namespaces in it.
#include "sema/declarations/namespaces.h"

#include "sema/declarations/diagnostics.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/names.h"
#include "sema/diagnostics.h"
#include "sema/fixes.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

bool isNamespace(Entity found) { return found.entityKind() == EntityKind::Namespace; }

Namespace& spaceAt(Context& context, uint32_t space) { return context.scopes.libraries.list[space]; }

// `Simatic.Ax`: the spelling of a namespace does not depend on which of its blocks comes first.
void adoptSpelling(Context& context, Namespace& space, NameId full) {
  if (!space.name || context.names().string(full) < context.names().string(space.name)) space.name = full;
}

// The namespace of this name in another one (or none), created on first use.
uint32_t namespaceNamed(Context& context, uint32_t outer, const Ident& name) {
  Libraries& libraries = context.scopes.libraries;
  const NameId key = keyOf(context, name.name);
  const std::string prefix = outer == kNoLibrary ? "" : toString(context, libraries.list[outer].name) + ".";
  const NameId full = context.names().intern(prefix + toString(context, name.name));
  NameMap& siblings = outer == kNoLibrary ? context.scopes.namespaces : libraries.list[outer].names;
  if (const Entity known = siblings.find(key)) {
    adoptSpelling(context, libraries.list[known.index], full);
    return known.index;
  }
  const auto created = static_cast<uint32_t>(libraries.list.size());
  siblings.insert(key, Entity::of(EntityKind::Namespace, created));
  libraries.list.emplace_back();
  Namespace& space = libraries.list.back();
  space.outer = outer;
  space.loc = name.loc;
  adoptSpelling(context, space, full);
  return created;
}

RegionId addRegion(Context& context, RegionId outer, uint32_t space, bool of_file = false) {
  context.scopes.regions.list.push_back({.outer = outer, .space = space, .of_file = of_file, .usings = {}, .open = {}});
  return RegionId{static_cast<uint32_t>(context.scopes.regions.list.size() - 1)};
}

// The namespace around a region; none at file level.
uint32_t spaceOf(const Context& context, RegionId region) {
  for (; region; region = context.scopes.regions.list[region.index].outer)
    if (context.scopes.regions.list[region.index].space != kNoLibrary)
      return context.scopes.regions.list[region.index].space;
  return kNoLibrary;
}

// The library among the sources to which a region belongs, or none.
uint32_t libraryAround(const Context& context, RegionId region) {
  for (; region; region = context.scopes.regions.list[region.index].outer)
    if (context.scopes.regions.list[region.index].library != kNoLibrary)
      return context.scopes.regions.list[region.index].library;
  return kNoLibrary;
}

RegionId regionOf(const Context& context, Entity found) {
  if (found.entityKind() == EntityKind::Pou) return context.scopes.pous[found.index].region;
  const NamedType* named = found.entityKind() == EntityKind::Type ? context.scopes.named(TypeId{found.index}) : nullptr;
  return named == nullptr ? RegionId{} : named->region;
}

struct Collector {
  Context& context;
  std::vector<DeclInRegion>& out;

  // Forbids declarations that a namespace cannot hold.   fails   NAMESPACE a CONFIGURATION c …            E0305
  void collect(Slice<DeclId> decls, FileId file, RegionId region, bool at_file_level) {
    const Tree& tree = context.tree();
    std::vector<DeclId> usings;
    for (uint32_t i = 0; i < decls.count; ++i)
      if (const DeclId decl = tree.list(decls)[i]; tree.kind(decl) == DeclKind::Using) usings.push_back(decl);
    if (at_file_level && !usings.empty()) region = addRegion(context, {}, kNoLibrary, true);
    if (!usings.empty()) context.scopes.regions.list[region.index].usings = std::move(usings);
    if (const uint32_t library = libraryOfSource(context, file); at_file_level && library != kNoLibrary) {
      region = addRegion(context, region, kNoLibrary);
      context.scopes.regions.list[region.index].library = library;
    }
    if (at_file_level && region) context.scopes.regions.of_file[file.index] = region;
    for (const DeclId decl : tree.list(decls)) {
      if (tree.kind(decl) == DeclKind::Using) continue;
      if (tree.kind(decl) == DeclKind::Namespace) {
        space(tree.as<NamespaceDecl>(decl), file, region);
      } else if (tree.kind(decl) == DeclKind::Configuration && !at_file_level) {
        context.report(diag::SectionNotAllowed, tree.loc(decl), {"CONFIGURATION", "NAMESPACE"});
      } else {
        out.push_back({decl, file, region});
      }
    }
  }

  void space(const NamespaceDecl& decl, FileId file, RegionId region) {
    uint32_t around = spaceOf(context, region);
    for (uint32_t i = 0; i < decl.path.count; ++i) {
      around = namespaceNamed(context, around, context.tree().list(decl.path)[i]);
      region = addRegion(context, region, around);
    }
    if (decl.path.empty()) return;  // reported by the parser
    if (decl.is_internal) spaceAt(context, around).internal = true;
    collect(decl.decls, file, region, false);
  }
};

// The entity that a namespace declares under a name: a NAMESPACE of the project, or a library.
Entity findInSpace(Context& context, uint32_t space, NameId key, bool types_only) {
  if (space <= context.scopes.libraries.project) return lookUpLibrary(context, key, space);
  const Namespace& from = spaceAt(context, space);
  if (const Entity found = from.names.find(key)) return found;
  if (types_only) return {};
  if (const Entity found = from.globals.find(key)) return found;
  return from.items.find(key);
}

// Forbids a bare name that several USINGs at one location open.
//   passes  USING a; USING b; … a.Pump          fails  … Pump, which both have           E0403
Entity findOpened(Context& context, RegionId region, NameId key, Loc loc, bool types_only) {
  Entity found, hidden;
  uint32_t from = kNoLibrary;
  for (const uint32_t space : context.scopes.regions.list[region.index].open) {
    const Entity here = findInSpace(context, space, key, types_only);
    if (!here || isNamespace(here) || (here.kind == found.kind && here.index == found.index)) continue;
    if (!isVisible(context, here)) {
      hidden = here;
      continue;
    }
    if (found) {
      const std::string first = toString(context, spaceAt(context, from).name),
                        second = toString(context, spaceAt(context, space).name);
      if (loc && isFirstReport(context, key))
        context.report(diag::AmbiguousName, loc, {context.names().string(key), first, second})
            .insert(loc, first + ".", Sureness::Proposal)
            .insert(loc, second + ".", Sureness::Proposal);
      return Entity::of(EntityKind::Error, 0);
    }
    found = here;
    from = space;
  }
  if (!found && hidden) {
    if (loc) checkVisible(context, hidden, loc);
    return Entity::of(EntityKind::Error, 0);
  }
  return found;
}

// The namespace that declares an entity, and whether only that may use it.
struct Declared {
  uint32_t space = kNoLibrary;
  bool is_internal = false;
};
Declared declaredIn(Context& context, Entity found) {
  switch (found.entityKind()) {
    case EntityKind::Pou:
      return {spaceOf(context, context.scopes.pous[found.index].region),
              context.symbols.pous[found.index].access == AccessLevel::Internal};
    case EntityKind::Type: {
      const NamedType* named = context.scopes.named(TypeId{found.index});
      return named == nullptr ? Declared{} : Declared{spaceOf(context, named->region), named->internal};
    }
    case EntityKind::Namespace: {
      const Namespace& space = spaceAt(context, found.index);
      return {space.outer, space.internal};
    }
    case EntityKind::None:
    case EntityKind::Error:
    case EntityKind::Var:
    case EntityKind::EnumValue:
    case EntityKind::GlobalList:
    case EntityKind::Property:
    case EntityKind::Program: break;
  }
  return {};
}

// Forbids USING of a name that is not a namespace.   fails   USING Sytem.Strings;                E0404
void openUsings(Context& context, RegionId region) {
  const Tree& tree = context.tree();
  for (size_t i = 0; i < context.scopes.regions.list[region.index].usings.size(); ++i) {
    const UsingDecl& decl = tree.as<UsingDecl>(context.scopes.regions.list[region.index].usings[i]);
    Context there = context;
    there.region = region;
    Entity space;
    for (uint32_t p = 0; p < decl.path.count; ++p) {
      const Ident& part = tree.list(decl.path)[p];
      const bool of_library = p > 0 && space.index <= there.scopes.libraries.project;
      space = p == 0       ? findNamespace(there, part.name)
              : of_library ? Entity{}
                           : spaceAt(there, space.index).names.find(keyOf(there, part.name));
      if (isNamespace(space)) continue;
      there.report(diag::UnknownNamespace, part.loc, {context.names().string(part.name)});
      break;
    }
    if (isNamespace(space) && checkVisible(there, space, tree.list(decl.path)[decl.path.count - 1].loc))
      context.scopes.regions.list[region.index].open.push_back(space.index);
  }
}

}  // namespace

RegionId regionOfFile(const Context& context, FileId file) {
  const auto found = context.scopes.regions.of_file.find(file.index);
  return found == context.scopes.regions.of_file.end() ? RegionId{} : found->second;
}

std::vector<DeclInRegion> collectNamespaces(Context& context) {
  std::vector<DeclInRegion> out;
  Collector collector{context, out};
  for (const FileUnit& unit : context.tree().files) collector.collect(unit.decls, unit.file, {}, true);
  for (uint32_t i = 1; i < context.scopes.regions.list.size(); ++i) openUsings(context, RegionId{i});
  return out;
}

RegionId regionOfPou(Context& context, const PouDecl& decl) {
  if (decl.usings.empty()) return context.region;
  const RegionId region = addRegion(context, context.region, kNoLibrary);
  for (const DeclId open : context.tree().list(decl.usings))
    context.scopes.regions.list[region.index].usings.push_back(open);
  openUsings(context, region);
  return region;
}

Namespace* namespaceAround(Context& context) {
  const uint32_t space = spaceOf(context, context.region);
  return space == kNoLibrary ? nullptr : &spaceAt(context, space);
}

uint32_t libraryOfSource(const Context& context, FileId file) {
  const std::vector<uint32_t>& of_source = context.scopes.libraries.of_source;
  return file.index < of_source.size() ? of_source[file.index] : kNoLibrary;
}

Namespace* namespaceFor(Context& context, NameId name) {
  if (Namespace* const space = namespaceAround(context); space != nullptr || !name) return space;
  const uint32_t library = libraryAround(context, context.region);
  if (library == kNoLibrary) return nullptr;
  const Entity other = context.scopes.pous_and_types.find(keyOf(context, name));
  return other && libraryAround(context, regionOf(context, other)) != library ? &spaceAt(context, library) : nullptr;
}

NameId qualifiedName(Context& context, NameId name) {
  const Namespace* space = namespaceFor(context, name);
  if (space == nullptr || !name) return name;
  return context.names().intern(toString(context, space->name) + "." + toString(context, name));
}

Entity lookUpAround(Context& context, NameId key, Loc loc, bool types_only) {
  for (RegionId at = context.region; at; at = context.scopes.regions.list[at.index].outer) {
    const Region& region = context.scopes.regions.list[at.index];
    if (region.of_file) break;  // the file's USINGs come after the project's names
    const uint32_t space = region.library != kNoLibrary ? region.library : region.space;
    if (space != kNoLibrary)
      if (const Entity found = findInSpace(context, space, key, types_only)) return found;
    if (const Entity found = findOpened(context, at, key, loc, types_only)) return found;
  }
  return {};
}

Entity lookUpOpened(Context& context, NameId key, Loc loc, bool types_only) {
  RegionId at = context.region;
  while (at && context.scopes.regions.list[at.index].outer) at = context.scopes.regions.list[at.index].outer;
  if (!context.scopes.regions.list[at.index].of_file) return {};
  return findOpened(context, at, key, loc, types_only);
}

Entity findNamespace(Context& context, NameId name) {
  const NameId key = keyOf(context, name);
  for (uint32_t space = spaceOf(context, context.region); space != kNoLibrary; space = spaceAt(context, space).outer)
    if (const Entity found = spaceAt(context, space).names.find(key); isNamespace(found)) return found;
  if (const Entity found = context.scopes.namespaces.find(key)) return found;
  return context.scopes.libraries.namespaces.find(key);
}

// The entity that a namespace declares under a name, given with the namespace. Of a library among the sources only what
// others declare too is in its namespace.
static Entity findQualified(Context& context, uint32_t space, NameId key) {
  const Entity found = findInSpace(context, space, key, false);
  if (found || !spaceAt(context, space).of_library) return found;
  return lookUpLibrary(context, key, context.scopes.libraries.project);
}

Entity lookUpNamespace(Context& context, uint32_t space, NameId key) {
  if (const Entity found = findQualified(context, space, key)) return found;
  // Its `qualified_only` variables are found only through its list.
  const Entity list = context.scopes.qualifiers.find(keyOf(context, spaceAt(context, space).name));
  if (space <= context.scopes.libraries.project || list.entityKind() != EntityKind::GlobalList) return {};
  return context.scopes.lists[list.index].names.find(key);
}

Entity lookUpQualified(Context& context, Slice<Ident> path) {
  const Entity error = Entity::of(EntityKind::Error, 0);
  const Ident first = context.tree().list(path)[0];
  Entity found = findNamespace(context, first.name);
  if (!found) {
    context.report(diag::UnknownName, first.loc, {context.names().string(first.name)})
        .didYouMean(nearestName(context, first.name));
    return error;
  }
  for (uint32_t i = 1; i < path.count; ++i) {
    const Ident part = context.tree().list(path)[i];
    const bool last = i + 1 == path.count;
    const bool of_library = found.index <= context.scopes.libraries.project ||
                            (isNamespace(found) && spaceAt(context, found.index).of_library);
    if (!last && of_library) {  // Lib.Sub.Motor: a library that Lib uses
      if (const Entity used = context.scopes.libraries.namespaces.find(keyOf(context, part.name))) found = used;
      continue;
    }
    if (!isNamespace(found)) {
      const Ident before = context.tree().list(path)[i - 1];
      context.report(diag::UnknownNamespace, before.loc, {context.names().string(before.name)});
      return error;
    }
    if (!checkVisible(context, found, context.tree().list(path)[i - 1].loc)) return error;
    const NameId key = keyOf(context, part.name);
    found = findQualified(context, found.index, key);
    if (last) found = orMock(context, key, found);
    if (!checkVisible(context, found, part.loc)) return error;
  }
  return found;
}

bool isInside(const Context& context, RegionId declared) {
  const uint32_t space = spaceOf(context, declared);
  if (space == kNoLibrary) return true;
  for (uint32_t at = spaceOf(context, context.region); at != kNoLibrary; at = context.scopes.libraries.list[at].outer)
    if (at == space) return true;
  return false;
}

bool isVisible(Context& context, Entity found) {
  const auto [space, is_internal] = declaredIn(context, found);
  if (!is_internal || space == kNoLibrary) return true;
  for (uint32_t at = spaceOf(context, context.region); at != kNoLibrary; at = spaceAt(context, at).outer)
    if (at == space) return true;
  return false;
}

// Forbids the use of an entity that is INTERNAL to another namespace. IEC 61131-3 ed. 3 table 64, 1b, 5.
//   fails   NAMESPACE a FUNCTION INTERNAL f … END_NAMESPACE … y := a.f();               E0552
bool checkVisible(Context& context, Entity found, Loc loc) {
  if (isVisible(context, found)) return true;
  NameId name;
  if (found.entityKind() == EntityKind::Pou) name = context.symbols.pous[found.index].name;
  if (found.entityKind() == EntityKind::Type) name = context.types().info(TypeId{found.index}).name;
  if (isNamespace(found)) name = spaceAt(context, found.index).name;
  context.report(diag::NotAccessible, loc,
                 {context.names().string(name), "INTERNAL",
                  context.names().string(spaceAt(context, declaredIn(context, found).space).name)});
  return false;
}

std::string_view nameElsewhere(Context& context, NameId key) {
  Libraries& libraries = context.scopes.libraries;
  for (uint32_t space = libraries.project + 1; space < libraries.list.size(); ++space) {
    const Entity found = findInSpace(context, space, key, false);
    if (!found || isNamespace(found) || !isVisible(context, found)) continue;
    NameId name = key;
    if (found.entityKind() == EntityKind::Pou) name = context.symbols.pous[found.index].name;
    if (found.entityKind() == EntityKind::Var) name = context.symbols.vars[found.index].name;
    if (found.entityKind() == EntityKind::EnumValue) name = context.symbols.enum_values[found.index].name;
    if (found.entityKind() == EntityKind::Type)
      return context.names().string(context.types().info(TypeId{found.index}).name);
    return context.names().string(
        context.names().intern(toString(context, libraries.list[space].name) + "." + toString(context, name)));
  }
  return {};
}

}  // namespace rung::sema
