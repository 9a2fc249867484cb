// SPDX-License-Identifier: Apache-2.0
// Collects declarations: every POU, type, enumeration item and global of the files gets its entity and its name, so
// that the order of files and declarations does not matter. Nothing is resolved here.
#include "sema/declarations/collect.h"

#include <string>

#include "frontend/syntax/diagnostics.h"
#include "sema/declarations/attributes.h"
#include "sema/declarations/charts.h"
#include "sema/declarations/configuration.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/namespaces.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/overloads.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

using types::RecordKind;

namespace {

template <typename Names>
struct KnownName {
  NameId Names::*name;
  std::string_view text;
};
using KnownNames = Scopes::KnownNames;
constexpr KnownName<KnownNames> kKnownNames[] = {
    {&KnownNames::test, "test"},
    {&KnownNames::test_only, "test_only"},
    {&KnownNames::replaces, "replaces"},
    {&KnownNames::mock, "mock"},
    {&KnownNames::skip, "skip"},
    {&KnownNames::setup, "setup"},
    {&KnownNames::teardown, "teardown"},
    {&KnownNames::test_case, "case"},
    {&KnownNames::safe_values, "safe_values"},
    {&KnownNames::before_task, "before_task"},
    {&KnownNames::after_task, "after_task"},
    {&KnownNames::alias, "alias"},
    {&KnownNames::required, "required"},
    {&KnownNames::optional, "optional"},
    {&KnownNames::lazy, "lazy"},
    {&KnownNames::long_time, "long_time"},
    {&KnownNames::extensible, "extensible"},
    {&KnownNames::prefix, "prefix"},
    {&KnownNames::sized, "sized"},
    {&KnownNames::slice, "slice"},
    {&KnownNames::pure, "pure"},
    {&KnownNames::native, "native"},
    {&KnownNames::op, "operator"},
    {&KnownNames::std, "std"},
    {&KnownNames::no_final_scan, "no_final_scan"},
    {&KnownNames::list, "list"},
    {&KnownNames::fault, "fault"},
    {&KnownNames::no_copy, "no_copy"},
    {&KnownNames::bytes, "bytes"},
};
constexpr KnownName<KnownNames::Attributes> kAttributes[] = {
    {&KnownNames::Attributes::qualified_only, "qualified_only"},
    {&KnownNames::Attributes::strict, "strict"},
    {&KnownNames::Attributes::instance_path, "instance-path"},
    {&KnownNames::Attributes::no_check, "no_check"},
    {&KnownNames::Attributes::no_virtual_actions, "no_virtual_actions"},
    {&KnownNames::Attributes::obsolete, "obsolete"},
    {&KnownNames::Attributes::to_string, "to_string"},
    {&KnownNames::Attributes::unique_name, "unique_name"},
    {&KnownNames::Attributes::call_after_init, "call_after_init"},
    {&KnownNames::Attributes::pack_mode, "pack_mode"},
    {&KnownNames::Attributes::global_init_slot, "global_init_slot"},
    {&KnownNames::Attributes::after_globals, "call_after_global_init_slot"},
    {&KnownNames::Attributes::initialize_on_call, "initialize_on_call"},
    {&KnownNames::Attributes::is_connected, "is_connected"},
    {&KnownNames::Attributes::reflection, "reflection"},
    {&KnownNames::Attributes::no_exit, "no-exit"},
    {&KnownNames::Attributes::no_copy, "no_copy"},
    {&KnownNames::Attributes::init_on_change, "init_on_onlchange"},
    {&KnownNames::Attributes::symbol, "symbol"},
};

}  // namespace

void internKnownNames(Context& context) {
  const auto keyOf = [&](std::string_view text) { return context.names().key(context.names().intern(text)); };
  KnownNames& known = context.scopes.known_names;
  for (const auto& row : kKnownNames) known.*row.name = keyOf(row.text);
  for (const auto& row : kAttributes) known.attributes.*row.name = keyOf(row.text);
}

const Pragma* findPragma(const Context& context, const DeclHeader& header, NameId key) {
  if (header.pragmas.empty()) return nullptr;
  const Tree& tree = context.tree();
  for (const Pragma& pragma : tree.list(header.pragmas)) {
    if (keyOf(context, pragma.name) == key) return &pragma;
  }
  return nullptr;
}

// Forbids two declarations of one name in one scope. IEC 61131-3 ed. 3, 6.1.2.
//   passes  FUNCTION f … FUNCTION g …
//   fails   FUNCTION f … FUNCTION F …                  E0301
void reportTwice(Context& context, NameId name, Loc loc, Loc first) {
  Report report = context.report(diag::DuplicateDeclaration, loc, {context.names().string(name)});
  if (first) report.alsoDeclaredHere(first);
}

NamedType& addNamed(Context& context, TypeId type) {
  Scopes& scopes = context.scopes;
  if (scopes.named_types.of_type.size() <= type.index) scopes.named_types.of_type.resize(type.index + 1, 0);
  scopes.named_types.of_type[type.index] = static_cast<uint32_t>(scopes.named_types.list.size());
  scopes.named_types.list.emplace_back();
  scopes.declared_types.push_back(type);
  return scopes.named_types.list.back();
}

namespace {

Loc locOf(Context& context, Entity found) {
  Project& project = context.project;
  switch (found.entityKind()) {
    case EntityKind::Var: return project.vars[found.index].loc;
    case EntityKind::Pou: return project.pous[found.index].loc;
    case EntityKind::Type: {
      NamedType* named = context.scopes.named(TypeId{found.index});
      return named != nullptr && named->decl ? context.tree().loc(named->decl) : Loc{};
    }
    case EntityKind::EnumValue: return project.enum_values[found.index].loc;
    case EntityKind::GlobalList: return project.global_lists[found.index].loc;
    case EntityKind::Program: return project.instances[found.index].loc;
    case EntityKind::Property: return project.properties[found.index].loc;
    case EntityKind::Namespace: return context.scopes.libraries.list[found.index].loc;
    case EntityKind::None:
    case EntityKind::Error: return {};
  }
  return {};
}

void declare(Context& context, NameMap& names, NameId name, Loc loc, Entity declared) {
  if (!name) return;
  const NameId key = keyOf(context, name);
  Entity first;
  if (&names == &context.scopes.pous_and_types) first = context.scopes.namespaces.find(key);
  if (!first && !names.insert(key, declared)) {
    first = names.find(key);
    if (declared.entityKind() == EntityKind::Pou && addOverload(context, first, PouId{declared.index})) return;
  }
  if (first) reportTwice(context, name, loc, locOf(context, first));
}

// {operator 'select'}, {operator 'add'} of functions of the standard library.
void takeOperator(Context& context, const DeclHeader& header, Pou& pou) {
  const Pragma* const pragma = findPragma(context, header, context.scopes.known_names.op);
  if (pragma == nullptr) return;
  const std::string_view word = context.tree().string(pragma->value);
  static constexpr std::pair<std::string_view, OperatorKind> kOperators[] = {{"select", OperatorKind::Select},
                                                                             {"mux", OperatorKind::Mux},
                                                                             {"convert", OperatorKind::Convert},
                                                                             {"move", OperatorKind::Move}};
  const auto* row = std::find_if(std::begin(kOperators), std::end(kOperators),
                                 [&](const auto& candidate) { return candidate.first == word; });
  if (row != std::end(kOperators))
    pou.pragmas.operator_kind = row->second;
  else if (types::findOp(word, pou.pragmas.op))
    pou.pragmas.operator_kind = OperatorKind::Op;
}

// {test}, {skip 'why'}, {replaces 'Other'} and what else is there for tests.
void takeTestPragmas(Context& context, const DeclHeader& header, bool of_library, Pou& pou) {
  const Scopes::KnownNames& known = context.scopes.known_names;
  const auto has = [&](NameId name) { return findPragma(context, header, name) != nullptr; };
  pou.pragmas.test = has(known.test);
  pou.pragmas.setup = has(known.setup);
  pou.pragmas.teardown = has(known.teardown);
  pou.pragmas.safe_values = has(known.safe_values);
  pou.pragmas.test_only = has(known.test_only) || pou.pragmas.setup || pou.pragmas.teardown;
  if (const Pragma* pragma = findPragma(context, header, known.skip); pragma != nullptr) {
    const std::string_view why = context.tree().string(pragma->value);
    pou.pragmas.skip = context.names().intern(why.empty() ? "no reason given" : why);
  }
  if (const Pragma* pragma = findPragma(context, header, known.replaces); pragma != nullptr && !of_library) {
    pou.pragmas.replaces = context.names().intern(context.tree().string(pragma->value));
    pou.pragmas.test_only = true;
  }
}

void takePragmas(Context& context, const PouDecl& decl, bool of_library, Pou& pou) {
  const Scopes::KnownNames& known = context.scopes.known_names;
  const auto has = [&](NameId name) { return findPragma(context, decl.h, name) != nullptr; };
  pou.pragmas.native = decl.body_kind == BodyKind::Native || has(known.native);
  pou.pragmas.pure = has(known.pure);
  pou.pragmas.prefix = has(known.prefix);
  pou.pragmas.sized = has(known.sized);
  pou.pragmas.slice = has(known.slice);
  pou.pragmas.faults = has(known.fault);
  pou.pragmas.no_copy = has(known.no_copy);
  pou.pragmas.bytes = has(known.bytes);
  pou.pragmas.call_after_init = has(known.attributes.call_after_init);
  pou.pragmas.no_virtual_actions = has(known.attributes.no_virtual_actions);
  pou.pragmas.no_check = has(known.attributes.no_check);
  takeAttributes(context, decl.h, pou);
  takeTestPragmas(context, decl.h, of_library, pou);
  takeOperator(context, decl.h, pou);
}

// The structure of the variables of a program, function block or interface.
void addRecord(Context& context, PouId id, const PouDecl& decl, bool of_library) {
  Pou& pou = context.project.pous[id.index];
  if (pou.kind == PouKind::Function) return;
  const RecordKind kind = pou.kind == PouKind::Program     ? RecordKind::Program
                          : pou.kind == PouKind::Interface ? RecordKind::Interface
                                                           : RecordKind::FunctionBlock;
  pou.record = context.types().addRecord(kind, pou.unique_name);
  if (pou.kind == PouKind::FunctionBlock) context.types().edit(pou.record).pack = packModeOf(context, decl.h);
  NamedType& named = addNamed(context, pou.record);
  named.pou = id;
  named.file = pou.file;
  named.library = of_library;
  named.region = context.region;
}

// VAR_GLOBAL in a program: a list that has its name.
void collectGlobals(Context& context, const Pou& pou, const PouDecl& decl) {
  if (!mayHoldGlobals(context, pou.kind)) return;
  Scopes& scopes = context.scopes;
  for (const DeclId id : context.tree().list(decl.sections)) {
    const SectionDecl& section = context.tree().as<SectionDecl>(id);
    if (section.section != SectionKind::Global) continue;
    const ListId list = listNamed(context, toString(context, pou.name), pou.file, section.h.loc, scopes.qualifiers);
    addGlobals(context, list, id, scopes.globals);
  }
}

void enterLibrary(Context& context, PouId id, uint32_t library) {
  Scopes& scopes = context.scopes;
  Pou& pou = context.project.pous[id.index];
  pou.library = pou.progress.used = true;
  pou.library_name = scopes.libraries.list[library].name;
  declare(context, scopes.libraries.list[library].names, pou.name, pou.loc, entity(id));
  pou.unique_name = uniqueNameInLibrary(context, library, pou.name);
  if (!pou.record) return;
  context.types().edit(pou.record).name = pou.unique_name;
  if (pou.unique_name != pou.name)
    context.types().edit(pou.record).shown_name = nameWithLibrary(context, library, pou.name);
}

void collectPou(Context& context, DeclId id, FileId file, uint32_t library) {
  Project& project = context.project;
  Scopes& scopes = context.scopes;
  const PouDecl& decl = context.tree().as<PouDecl>(id);
  const bool of_library = library != kNoLibrary;
  const PouId pou_id{static_cast<uint32_t>(project.pous.size())};
  project.pous.emplace_back();
  scopes.pous.emplace_back();
  Pou& pou = project.pous.back();
  scopes.pous.back().region = regionOfPou(context, decl);
  Namespace* const space = of_library ? nullptr : namespaceFor(context, decl.name);
  pou.name = decl.name;
  pou.unique_name = qualifiedName(context, decl.name);
  pou.loc = decl.h.loc;
  pou.kind = decl.pou_kind;
  pou.decl = id;
  pou.file = file;
  pou.cpp.is_body = decl.body_kind == BodyKind::Cpp;
  pou.access = decl.access;
  pou.object.modifiers = decl.modifiers;
  takePragmas(context, decl, of_library, pou);
  addRecord(context, pou_id, decl, of_library);
  if (decl.body_kind == BodyKind::Sfc || !decl.transitions.empty()) declareChart(context, pou_id);
  if (of_library)
    enterLibrary(context, pou_id, library);
  else
    declare(context, space != nullptr ? space->names : scopes.pous_and_types, pou.name, pou.loc, entity(pou_id));
  collectMembers(context, pou_id);
  if (!of_library) collectGlobals(context, pou, decl);
}

void collectType(Context& context, DeclId id, FileId file, uint32_t library) {
  Scopes& scopes = context.scopes;
  const Tree& tree = context.tree();
  const TypeDecl& decl = tree.as<TypeDecl>(id);
  types::TypeTable& table = context.types();
  NameId name = qualifiedName(context, decl.name);
  Namespace* const space = library == kNoLibrary ? namespaceFor(context, decl.name) : &scopes.libraries.list[library];
  NameMap& names = space != nullptr ? space->names : scopes.pous_and_types;
  if (library != kNoLibrary && name) name = uniqueNameInLibrary(context, library, name);
  TypeId type = types::kError;
  switch (tree.kind(decl.type)) {
    case TypeExprKind::Enum: type = table.addEnum(name, types::kInt); break;
    case TypeExprKind::Subrange: type = table.addSubrange(name, types::kInt, 0, 0); break;
    case TypeExprKind::Struct:
      type = addStructure(context, decl.type, name);
      table.edit(type).pack = packModeOf(context, decl.h);
      break;
    case TypeExprKind::Error:
    case TypeExprKind::Named:
    case TypeExprKind::String:
    case TypeExprKind::Array:
    case TypeExprKind::Pointer: type = table.addAlias(name, types::kError); break;
  }
  const bool is_structure = tree.kind(decl.type) == TypeExprKind::Struct;
  if (library != kNoLibrary && name != decl.name && tree.kind(decl.type) != TypeExprKind::Error)
    table.edit(type).shown_name = nameWithLibrary(context, library, decl.name);
  checkAttributes(context, decl.h, is_structure ? Attributed::Structure : Attributed::OtherType);
  NamedType& named = addNamed(context, type);
  named.decl = id;
  named.type = decl.type;
  named.file = file;
  named.library = library != kNoLibrary;
  named.internal = decl.is_internal;
  named.region = context.region;
  declare(context, names, decl.name, decl.h.loc, entity(type));
  if (tree.kind(decl.type) == TypeExprKind::Enum) {
    const bool qualified = findPragma(context, decl.h, scopes.known_names.attributes.qualified_only) != nullptr;
    table.edit(type).strict = findPragma(context, decl.h, scopes.known_names.attributes.strict) != nullptr;
    table.edit(type).qualified = qualified;
    NameMap* bare = library != kNoLibrary ? &names : space != nullptr ? &space->items : &scopes.items;
    declareItems(context, type, decl.type, qualified ? nullptr : bare, library == kNoLibrary);
  }
}

// {list 'Plant'} names the list of this section and of those after it in the file: in PLCopen XML, one file holds many
// lists. Otherwise a list has the name of its file.
std::string listOfSection(Context& context, const SectionDecl& section, FileId file) {
  Scopes& scopes = context.scopes;
  if (const Pragma* pragma = findPragma(context, section.h, scopes.known_names.list)) {
    scopes.open_list.file = file;
    scopes.open_list.name = context.tree().string(pragma->value);
  }
  const bool is_named = scopes.open_list.file == file && !scopes.open_list.name.empty();
  return is_named ? scopes.open_list.name : listNameOf(context.symbols.sources.path(file));
}

}  // namespace

// The list of this name, created on first use.
ListId listNamed(Context& context, const std::string& name, FileId file, Loc loc, NameMap& qualifiers) {
  Project& project = context.project;
  Scopes& scopes = context.scopes;
  NameId id = context.names().intern(name);
  const Entity known = qualifiers.find(keyOf(context, id));
  if (known.entityKind() == EntityKind::GlobalList) return ListId{known.index};
  const ListId list_id{static_cast<uint32_t>(project.global_lists.size())};
  qualifiers.insert(keyOf(context, id), Entity::of(EntityKind::GlobalList, list_id.index));
  // The list's record shares a name space with POUs and types in generated code.
  const NameId key = keyOf(context, id), other = context.names().intern(name + "_globals");
  const NameId record = scopes.libraries.index.find(key) ? other : id;
  if (scopes.pous_and_types.find(key)) id = other;
  project.global_lists.emplace_back();
  scopes.lists.emplace_back();
  GlobalList& list = project.global_lists.back();
  list.name = id;
  list.loc = loc;
  list.record = context.types().addRecord(RecordKind::GlobalList, id == other ? other : record);
  scopes.lists.back().file = file;
  NamedType& named = addNamed(context, list.record);
  named.file = file;
  return list_id;
}

// Adds a global variable to those of its name in other resources. False: both are of one resource, or of none.
static bool addToResourceGlobals(Context& context, NameId key, VarId first, VarId added) {
  Project& project = context.project;
  const auto resourceOf = [&](VarId id) {
    const NameId resource = project.global_lists[project.var(id).list.index].resource;
    return resource ? keyOf(context, resource) : NameId{};
  };
  Entity family = context.scopes.resource_globals.find(key);
  if (!family) {
    if (resourceOf(first) == resourceOf(added)) return false;
    family = Entity::of(EntityKind::Var, static_cast<uint32_t>(project.resource_globals.size()));
    context.scopes.resource_globals.insert(key, family);
    project.resource_globals.push_back({{{resourceOf(first), first}}});
  }
  std::vector<ResourceGlobals::Own>& all = project.resource_globals[family.index].all;
  for (const ResourceGlobals::Own& own : all)
    if (own.resource == resourceOf(added)) return false;
  all.push_back({resourceOf(added), added});
  return true;
}

// {attribute 'unique_name'}: the variables that Rung makes of a `.cam` file, whose name a program cannot qualify.
static bool hasUniqueName(const Context& context, const Var& var) {
  if (!var.decl) return false;
  const DeclHeader& header = context.tree().decl(var.decl);
  return !header.pragmas.empty() &&
         findPragma(context, header, context.scopes.known_names.attributes.unique_name) != nullptr;
}

void addGlobals(Context& context, ListId list_id, DeclId section_id, NameMap& bare) {
  Project& project = context.project;
  Scopes& scopes = context.scopes;
  const SectionDecl& section = context.tree().as<SectionDecl>(section_id);
  GlobalList& list = project.global_lists[list_id.index];
  ListScope& scope = scopes.lists[list_id.index];
  checkModifiers(context, section);
  checkAttributes(context, section.h, Attributed::Globals);
  if (const auto slot = initSlotOf(context, section.h)) list.init_slot = *slot;
  list.symbol_access = symbolAccessOf(context, section.h).value_or(types::SymbolAccess::ReadWrite);
  const bool qualified_only = findPragma(context, section.h, scopes.known_names.attributes.qualified_only) != nullptr;
  if (qualified_only) list.qualified_only = true;
  const size_t first = list.vars.size();
  for (const DeclId decl : context.tree().list(section.vars)) {
    scope.decls.push_back(decl);
    declareVars(context, decl, section, {}, list_id, &scope.names, list.vars);
  }
  for (size_t i = first; context.region && i < list.vars.size(); ++i)
    scopes.regions.of_global[list.vars[i].index] = context.region;
  if (qualified_only) return;
  for (size_t i = first; i < list.vars.size(); ++i) {
    const Var& var = project.var(list.vars[i]);
    if (!var.name) continue;
    const NameId key = keyOf(context, var.name);
    if (bare.insert(key, entity(list.vars[i]))) continue;
    const Entity other = bare.find(key);
    if (other.entityKind() != EntityKind::Var || project.vars[other.index].list.index == list_id.index) continue;
    if (hasUniqueName(context, var) || hasUniqueName(context, project.vars[other.index])) {
      reportTwice(context, var.name, var.loc, project.vars[other.index].loc);
      continue;
    }
    if (&bare == &scopes.globals && addToResourceGlobals(context, key, VarId{other.index}, list.vars[i])) continue;
    const std::string_view here = context.names().string(list.name);
    const std::string_view there =
        context.names().string(project.global_lists[project.vars[other.index].list.index].name);
    context.report(diag::GlobalAlsoDeclared, var.loc, {context.names().string(var.name), there, here})
        .alsoDeclaredHere(project.vars[other.index].loc);
  }
}

namespace {

// The position of a library's declaration among those of its file: it names a list, and survives other comments.
size_t declarationNumber(const Context& context, FileId file, Loc loc) {
  const Libraries& libraries = context.scopes.libraries;
  const uint32_t offset = loc.offset - context.symbols.sources.begin(file).offset;
  return static_cast<size_t>(std::count_if(
      libraries.blocks.begin(), libraries.blocks.end(),
      [&](const LibraryBlock& block) { return libraries.sources[block.file] == file && block.begin <= offset; }));
}

}  // namespace

void declareItems(Context& context, TypeId type, TypeExprId written, NameMap* bare, bool project_wide) {
  Project& project = context.project;
  Scopes& scopes = context.scopes;
  NamedType& named = *scopes.named(type);
  const EnumTypeExpr& expr = context.tree().as<EnumTypeExpr>(written);
  for (const EnumItem& item : context.tree().list(expr.items)) {
    const auto index = static_cast<uint32_t>(project.enum_values.size());
    project.enum_values.push_back({item.item.name, type, 0, item.item.loc});
    const Entity declared = Entity::of(EntityKind::EnumValue, index);
    const NameId key = keyOf(context, item.item.name);
    if (!named.members.insert(key, declared)) {
      reportTwice(context, item.item.name, item.item.loc, locOf(context, named.members.find(key)));
      continue;
    }
    if (bare == nullptr || bare->insert(key, declared)) continue;
    const Entity first = bare->find(key);
    if (!project_wide || first.entityKind() != EntityKind::EnumValue) continue;
    if (scopes.item_is_ambiguous.size() <= first.index) scopes.item_is_ambiguous.resize(first.index + 1, false);
    scopes.item_is_ambiguous[first.index] = true;
  }
}

// A list of the project or of a library among the sources. A library that has a list of the same name as others keeps
// it in its namespace.
void collectProjectGlobals(Context& context, DeclId decl, FileId file) {
  const Loc loc = context.tree().loc(decl);
  const std::string name = listOfSection(context, context.tree().as<SectionDecl>(decl), file);
  const uint32_t library = libraryOfSource(context, file);
  const NameId key = keyOf(context, context.names().intern(name));
  const Entity known = context.scopes.qualifiers.find(key);
  const bool is_taken = library != kNoLibrary && known.entityKind() == EntityKind::GlobalList &&
                        libraryOfSource(context, context.scopes.lists[known.index].file) != library;
  if (!is_taken) {
    const ListId list = listNamed(context, name, file, loc, context.scopes.qualifiers);
    return addGlobals(context, list, decl, context.scopes.globals);
  }
  Namespace& own = context.scopes.libraries.list[library];
  if (const Entity mine = own.names.find(key); mine.entityKind() == EntityKind::GlobalList)
    return addGlobals(context, ListId{mine.index}, decl, own.globals);
  NameMap ignored;
  const ListId list = listNamed(context, toString(context, own.name) + "_" + name, file, loc, ignored);
  own.names.insert(key, Entity::of(EntityKind::GlobalList, list.index));
  addGlobals(context, list, decl, own.globals);
}

void collectSection(Context& context, DeclId decl, FileId file, uint32_t library) {
  const Loc loc = context.tree().loc(decl);
  const SectionKind section = context.tree().as<SectionDecl>(decl).section;
  if (section == SectionKind::Config) return;                                 // instance_paths.cpp
  if (section == SectionKind::Access) return;                                 // access_paths.cpp
  if (Namespace* const space = namespaceAround(context); space != nullptr) {  // one list for all of its sections
    const ListId list = listNamed(context, toString(context, space->name), file, loc, context.scopes.qualifiers);
    return addGlobals(context, list, decl, space->globals);
  }
  if (library == kNoLibrary) return collectProjectGlobals(context, decl, file);
  Namespace& from = context.scopes.libraries.list[library];
  std::string name = toString(context, from.name) + "_" + listNameOf(context.symbols.sources.path(file));
  if (context.symbols.global_lists.size() > 1) name += "_" + std::to_string(declarationNumber(context, file, loc));
  const ListId list = listNamed(context, name, file, loc, from.names);
  context.scopes.named(context.symbols.global_lists[list.index].record)->library = true;
  addGlobals(context, list, decl, from.names);
}

void collectDecl(Context& context, DeclId decl, FileId file, uint32_t library) {
  switch (context.tree().kind(decl)) {
    case DeclKind::Pou: return collectPou(context, decl, file, library);
    case DeclKind::Type: return collectType(context, decl, file, library);
    case DeclKind::Section: return collectSection(context, decl, file, library);
    case DeclKind::Configuration:  // collectConfigurations
    case DeclKind::Resource:
    case DeclKind::Task:
    case DeclKind::ProgramInstance:
    case DeclKind::Property:
    case DeclKind::Var:
    case DeclKind::Namespace:  // collectNamespaces
    case DeclKind::Using: return;
  }
}

// A name that the project and its libraries have is the project's, else that of a library which is not INTERNAL; the
// others keep it for themselves.
static int rankOf(const Context& context, const DeclInRegion& placed) {
  if (libraryOfSource(context, placed.file) == kNoLibrary) return 0;
  const Tree& tree = context.tree();
  const DeclKind kind = tree.kind(placed.decl);
  const bool internal = (kind == DeclKind::Pou && tree.as<PouDecl>(placed.decl).access == AccessLevel::Internal) ||
                        (kind == DeclKind::Type && tree.as<TypeDecl>(placed.decl).is_internal);
  return internal ? 2 : 1;
}

void collectFiles(Context& context) {
  std::vector<DeclInRegion> declared = collectNamespaces(context);
  if (!context.project.options.library_projects.empty())
    std::stable_sort(declared.begin(), declared.end(), [&](const DeclInRegion& a, const DeclInRegion& b) {
      return rankOf(context, a) < rankOf(context, b);
    });
  // POUs and types first: a global list is named differently when a POU has its name.
  for (const bool sections : {false, true}) {
    for (const DeclInRegion& placed : declared) {
      if ((context.tree().kind(placed.decl) == DeclKind::Section) != sections) continue;
      Context there = at(context, {}, placed.file, false, placed.region);
      collectDecl(there, placed.decl, placed.file, kNoLibrary);
    }
  }
}

}  // namespace rung::sema
