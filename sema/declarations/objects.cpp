// SPDX-License-Identifier: Apache-2.0
// Objects: the methods, actions and properties of a block, class or interface, what it extends and implements, and the
// hidden fields with which its instances begin.
//
// An object that may be used through a pointer, an in-out or an interface begins with a 32-bit type id, by which its
// methods and its body are found (`dispatched`): an object with methods, interfaces or ABSTRACT, and one that the
// project extends. So the first derived block changes the layout of its base, and resolveHeaders() reads all headers
// before the first layout. A derived object holds its base as its first field, a nested record: the base's initialiser
// is that of a field, and no pointer is cast. If only the derived one has a type id, it comes first.
#include "sema/declarations/objects.h"

#include <algorithm>

#include "frontend/source/scanner.h"
#include "sema/declarations/attributes.h"
#include "sema/declarations/charts.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/limits.h"
#include "sema/declarations/namespaces.h"
#include "sema/declarations/overloads.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/diagnostics.h"
#include "sema/fixes.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

using types::TypeKind;

bool isLifeMethod(const Context& context, NameId name) {
  const std::string_view text = context.names().string(name);
  return sameIdentifier(text, "FB_Init") || sameIdentifier(text, "FB_Reinit") || sameIdentifier(text, "FB_Exit");
}

namespace {

// `Motor__Start`: unique among functions and members of the project.
NameId uniqueName(Context& context, const Pou& owner, const std::string& name) {
  Scopes& scopes = context.scopes;
  std::string unique = toString(context, owner.unique_name) + "__" + name;
  for (uint32_t n = 2;; ++n) {
    const NameId id = context.names().intern(unique);
    const NameId key = keyOf(context, id);
    if (!scopes.pous_and_types.find(key) && scopes.member_names.insert(key, Entity::of(EntityKind::Error, 0)))
      return id;
    unique = toString(context, owner.unique_name) + "__" + name + std::to_string(n);
  }
}

PouId addMember(Context& context, PouId owner_id, DeclId id, const char* accessor, PouId chart = {}) {
  Symbols& symbols = context.symbols;
  const PouDecl& decl = context.tree().as<PouDecl>(id);
  const PouId member_id{static_cast<uint32_t>(symbols.pous.size())};
  symbols.pous.emplace_back();
  context.scopes.pous.emplace_back();
  Pou& member = symbols.pous.back();
  Pou& owner = symbols.pou(owner_id);
  Context there = atPou(context, owner_id);
  member.chart = chart;
  context.scopes.pous.back().region = regionOfPou(there, decl);
  member.name = decl.name;
  member.loc = decl.h.loc;
  member.kind = decl.pou_kind;
  member.decl = id;
  member.file = owner.file;
  member.pragmas.native = decl.body_kind == BodyKind::Native;
  member.cpp.is_body = decl.body_kind == BodyKind::Cpp;
  member.library = owner.library;
  member.progress.used = owner.library;
  const Scopes::KnownNames& known = context.scopes.known_names;
  member.pragmas.faults = findPragma(context, decl.h, known.fault) != nullptr;
  member.pragmas.call_after_init = findPragma(context, decl.h, known.attributes.call_after_init) != nullptr;
  member.pragmas.before_task = findPragma(context, decl.h, known.before_task) != nullptr;
  member.pragmas.after_task = findPragma(context, decl.h, known.after_task) != nullptr;
  member.pragmas.no_check = findPragma(context, decl.h, known.attributes.no_check) != nullptr;
  takeAttributes(context, decl.h, member);
  member.library_name = owner.library_name;
  member.owner = owner_id;
  member.access = decl.access;
  member.object.modifiers = decl.modifiers;
  member.unique_name = uniqueName(context, owner, toString(context, decl.name) + accessor);
  if (owner.kind == PouKind::Interface) member.object.modifiers |= kAbstract;
  owner.members.push_back(member_id);
  if (decl.body_kind == BodyKind::Sfc) declareChart(there, member_id);
  for (uint32_t i = 0; i < decl.members.count; ++i)
    addMember(context, owner_id, context.tree().list(decl.members)[i], "", member_id);
  return member_id;
}

// Each chart in an action has a scope of its own between the action and the block (Pou::chart). A variable of such a
// chart gets its bare name in the whole block, as in CODESYS, if the name is unique there.
void shareChartVars(Context& context, PouId object) {
  Symbols& symbols = context.symbols;
  NameMap& names = context.scopes.pous[object.index].names;
  NameMap seen, twice;
  std::vector<std::pair<NameId, VarId>> shared;
  for (const PouId member : symbols.pou(object).members) {
    if (symbols.pou(member).kind != PouKind::Action) continue;
    context.scopes.pous[member.index].names.forEach([&](NameId key, Entity found) {
      if (found.entityKind() != EntityKind::Var || symbols.vars[found.index].pou != object) return;
      if (seen.insert(key, found))
        shared.push_back({key, VarId{found.index}});
      else
        twice.insert(key, found);
    });
  }
  std::sort(shared.begin(), shared.end(), [](const auto& a, const auto& b) { return a.second.index < b.second.index; });
  for (const auto& [key, var] : shared) {
    if (twice.find(key)) continue;
    if (const PouId base = symbols.pou(object).base; base && findInObject(context, base, key)) continue;
    if (!names.insert(key, entity(var))) continue;
    for (const Ident& name : context.tree().list(context.tree().as<VarDecl>(symbols.var(var).decl).names))
      if (keyOf(context, name.name) == key) symbols.var(var).name = name.name;
  }
}

// The object that a name in EXTENDS or IMPLEMENTS means; reports a name that is not an object.
PouId objectNamed(Context& context, TypeExprId written, bool want_interface) {
  const TypeId type = resolveType(context, written);
  if (type == types::kError) return {};
  const PouId interface = interfaceOf(context, type);
  const NamedType* named = context.scopes.named(context.types().resolve(type));
  const PouId block = named != nullptr ? named->pou : PouId{};
  if (want_interface ? static_cast<bool>(interface) : block && context.symbols.pou(block).kind != PouKind::Program)
    return want_interface ? interface : block;
  context.report(want_interface ? diag::NotAnInterface : diag::NotABase, context.tree().loc(written),
                 {context.types().toString(type)});
  return {};
}

}  // namespace

void collectMembers(Context& context, PouId owner) {
  const PouDecl& decl = context.tree().as<PouDecl>(context.symbols.pou(owner).decl);
  for (const DeclId member : context.tree().list(decl.members)) {
    if (context.tree().kind(member) == DeclKind::Pou) {
      addMember(context, owner, member, "");
      continue;
    }
    const PropertyDecl& property = context.tree().as<PropertyDecl>(member);
    Property created{property.name, property.h.loc, owner, {}, {}};
    if (property.get) {
      created.get = addMember(context, owner, property.get, "__get");
      context.symbols.pou(created.get).object.accessor = AccessorKind::Get;
    }
    if (property.set) {
      created.set = addMember(context, owner, property.set, "__set");
      context.symbols.pou(created.set).object.accessor = AccessorKind::Set;
    }
    context.symbols.pou(owner).object.properties.push_back(static_cast<uint32_t>(context.symbols.properties.size()));
    context.symbols.properties.push_back(created);
  }
}

void declareMembers(Context& context, PouId object) {
  Symbols& symbols = context.symbols;
  NameMap& names = context.scopes.pous[object.index].names;
  const auto declare = [&](NameId name, Loc loc, Entity declared) {
    if (!name || names.insert(keyOf(context, name), declared)) return;
    const Entity first = names.find(keyOf(context, name));
    if (declared.entityKind() == EntityKind::Pou && addOverload(context, first, PouId{declared.index})) return;
    if (symbols.pou(object).library && first.entityKind() == EntityKind::Var)
      return;  // SEMA.RELEASE: the call means the method
    const Loc known = first.entityKind() == EntityKind::Var        ? symbols.vars[first.index].loc
                      : first.entityKind() == EntityKind::Property ? symbols.properties[first.index].loc
                      : first.entityKind() == EntityKind::Pou      ? symbols.pous[first.index].loc
                                                                   : Loc{};
    reportTwice(context, name, loc, known);
  };
  for (const uint32_t property : symbols.pou(object).object.properties) {
    const Property& of = symbols.properties[property];
    declare(of.name, of.loc, Entity::of(EntityKind::Property, property));
  }
  for (const PouId member : symbols.pou(object).members) {
    if (const PouId chart = symbols.pou(member).chart)
      context.scopes.pous[chart.index].names.insert(keyOf(context, symbols.pou(member).name), entity(member));
    else if (symbols.pou(member).object.accessor == AccessorKind::None)
      declare(symbols.pou(member).name, symbols.pou(member).loc, entity(member));
    declarePou(context, member);  // its VAR_INST are variables of the object
  }
  shareChartVars(context, object);
}

namespace {

void decideDispatch(Context& context, PouId id) {
  Pou& pou = context.symbols.pou(id);
  const bool is_interface = pou.kind == PouKind::Interface;
  if (pou.kind != PouKind::FunctionBlock && pou.kind != PouKind::Class && !is_interface) return;
  if (pou.base) decideDispatch(context, pou.base);
  bool own =
      is_interface || pou.object.extended || !pou.object.interfaces.empty() || (pou.object.modifiers & kAbstract) != 0;
  for (const PouId member : pou.members) {
    const Pou& method = context.symbols.pou(member);
    own = own || (method.kind == PouKind::Method && (pou.object.modifiers & kFinal) == 0 &&
                  !isLifeMethod(context, method.name));
  }
  pou.object.dispatched = own || (pou.base && context.symbols.pou(pou.base).object.dispatched);
}

}  // namespace

namespace {

// A name with the comma before it.
Fix withoutRepeated(const Context& context, Loc name) {
  const std::string_view token = context.symbols.sources.tokenAt(name);
  const Loc end{name.offset + static_cast<uint32_t>(token.size())};
  Loc begin = name;
  while (begin.offset > 0 && isBlankCharacter(*(token.data() - (name.offset - begin.offset) - 1))) --begin.offset;
  if (*(token.data() - (name.offset - begin.offset) - 1) != ',') return {};
  return {"Remove `" + std::string(token) + "`", {{{begin.offset - 1}, end, {}}}, true};
}

// Warns of a duplicate interface in one list.
//   passes  IMPLEMENTS IRun, IStop      warns   IMPLEMENTS IRun, IRun                                       W0346
void addInterface(Context& there, Pou& pou, PouId interface, Loc loc) {
  if (std::find(pou.object.interfaces.begin(), pou.object.interfaces.end(), interface) == pou.object.interfaces.end())
    pou.object.interfaces.push_back(interface);
  else
    there.report(diag::DuplicateInterface, loc, {there.names().string(there.symbols.pou(interface).name)})
        .fix(withoutRepeated(there, loc));
}

}  // namespace

// Forbids EXTENDS of anything but a block, class or interface, of a FINAL one, and of itself; IMPLEMENTS of anything
// but an interface. IEC 61131-3 ed. 3, 6.6.5.5, 6.6.6.5.
//   fails   FUNCTION_BLOCK a EXTENDS b … FUNCTION_BLOCK b EXTENDS a …                 E0352
void resolveHeader(Context& context, PouId id) {
  Symbols& symbols = context.symbols;
  if (symbols.pou(id).progress.header != Pou::Progress::Header::New || !symbols.pou(id).decl) return;
  symbols.pou(id).progress.header = Pou::Progress::Header::Busy;
  // Its layout must not depend on whether that block is read later.
  if (symbols.pou(id).library && !symbols.pou(id).pragmas.native && symbols.pou(id).kind != PouKind::Function)
    symbols.pou(id).object.extended =
        static_cast<bool>(context.scopes.libraries.extended.find(keyOf(context, symbols.pou(id).name)));
  Context there = atPou(context, id);
  there.pou = {};
  const PouDecl& decl = context.tree().as<PouDecl>(symbols.pou(id).decl);
  const bool is_interface = decl.pou_kind == PouKind::Interface;
  for (const TypeExprId written : context.tree().list(decl.bases)) {
    const PouId base = objectNamed(there, written, is_interface);
    if (!base) {
      symbols.pou(id).object.unresolved = true;
      continue;
    }
    if (context.scopes.depth > kMaxDeclarationDepth) {
      there.report(diag::DeclarationsTooDeep, context.tree().loc(written),
                   {context.names().string(symbols.pou(id).name)});
      continue;
    }
    ++context.scopes.depth;
    resolveHeader(context, base);
    --context.scopes.depth;
    if (symbols.pou(base).object.unresolved) symbols.pou(id).object.unresolved = true;
    const uint32_t depth = symbols.pou(base).object.base_depth + 1;
    if (depth > kMaxBases) {
      reportTooDeep(there, context.tree().loc(written), "bases", kMaxBases);
      continue;
    }
    symbols.pou(id).object.base_depth = std::max(symbols.pou(id).object.base_depth, depth);
    const std::string_view name = context.names().string(symbols.pou(base).name);
    if (symbols.pou(base).progress.header == Pou::Progress::Header::Busy) {
      there.report(diag::ExtendsItself, context.tree().loc(written), {context.names().string(symbols.pou(id).name)});
    } else if (is_interface) {
      addInterface(there, symbols.pou(id), base, context.tree().loc(written));
    } else if (symbols.pou(id).base) {
      there.report(diag::SeveralBases, context.tree().loc(written), {context.names().string(symbols.pou(id).name)});
    } else if ((symbols.pou(base).object.modifiers & kFinal) != 0) {
      there.report(diag::ExtendsFinal, context.tree().loc(written), {name}).declaredHere(symbols.pou(base).loc);
    } else {
      symbols.pou(id).base = base;
      if (!symbols.pou(base).pragmas.native) symbols.pou(base).object.extended = true;
    }
  }
  for (const TypeExprId written : context.tree().list(decl.implements)) {
    if (const PouId interface = objectNamed(there, written, true)) {
      resolveHeader(context, interface);
      addInterface(there, symbols.pou(id), interface, context.tree().loc(written));
    }
  }
  symbols.pou(id).progress.header = Pou::Progress::Header::Done;
  decideDispatch(context, id);
}

void resolveHeaders(Context& context) {
  context.scopes.resolving = true;  // a library block that is read now may yet be extended
  for (uint32_t i = 1; i < context.symbols.pous.size(); ++i)
    if (!context.symbols.pous[i].owner) resolveHeader(context, PouId{i});
  context.scopes.resolving = false;
  for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) decideDispatch(context, PouId{i});
}

void addObjectFields(Context& context, PouId id) {
  Symbols& symbols = context.symbols;
  resolveHeader(context, id);
  Pou& pou = symbols.pou(id);
  const auto hidden = [&](std::string_view name, TypeId type) {
    Var var;
    var.name = context.names().intern(name);
    var.loc = pou.loc;
    var.type = type;
    var.storage = Storage::Field;
    var.pou = id;
    var.used = {1, 1};
    const VarId created{static_cast<uint32_t>(symbols.vars.size())};
    symbols.vars.push_back(var);
    pou.vars.insert(pou.vars.begin() + (pou.object.id_var ? 1 : 0), created);
    return created;
  };
  if (pou.object.dispatched && !(pou.base && symbols.pou(pou.base).object.dispatched))
    pou.object.id_var = hidden("__type", types::idOf(types::TypeKind::UDInt));
  if (pou.base) pou.object.base_var = hidden("SUPER", symbols.pou(pou.base).record);
}

PouId constructorOf(const Context& context, PouId object) {
  for (PouId at = object; at; at = context.symbols.pou(at).base)
    for (const PouId member : context.symbols.pou(at).members)
      if (sameIdentifier(context.names().string(context.symbols.pou(member).name), "FB_Init")) return member;
  return {};
}

PouId objectOf(const Context& context) {
  if (!context.pou) return {};
  const Pou& pou = context.symbols.pou(context.pou);
  if (pou.owner) return pou.owner;
  return pou.kind == PouKind::Function ? PouId{} : context.pou;
}

Entity findInObject(Context& context, PouId object, NameId name) {
  const NameId key = keyOf(context, name);
  for (PouId at = object; at; at = context.symbols.pou(at).base) {
    resolveHeader(context, at);
    declarePou(context, at);
    if (const Entity found = context.scopes.pous[at.index].names.find(key)) {
      if (found.entityKind() != EntityKind::Var) return found;
      if (context.symbols.vars[found.index].pou == at) {
        ensureVarType(context, VarId{found.index});
        return found;
      }
    }
    if (context.symbols.pou(at).kind != PouKind::Interface) continue;
    for (const PouId base : context.symbols.pou(at).object.interfaces)
      if (const Entity found = findInObject(context, base, name)) return found;
  }
  return {};
}

bool isKindOf(Context& context, PouId object, PouId base) {
  for (PouId at = object; at; at = context.symbols.pou(at).base) {
    if (at == base) return true;
    resolveHeader(context, at);
    for (const PouId interface : context.symbols.pou(at).object.interfaces)
      if (isKindOf(context, interface, base)) return true;
  }
  return false;
}

PouId interfaceOf(Context& context, TypeId type) {
  const types::TypeInfo& pointer = context.types().info(context.types().resolve(type));
  if (pointer.kind != types::TypeKind::Pointer) return {};
  const TypeId record = context.types().resolve(pointer.base);
  const types::TypeInfo& info = context.types().info(record);
  if (info.kind != types::TypeKind::Record || info.record_kind != types::RecordKind::Interface) return {};
  return context.scopes.named(record)->pou;
}

PouId pouOf(Context& context, TypeId record) {
  const NamedType* named = context.scopes.named(context.types().resolve(record));
  return named == nullptr ? PouId{} : named->pou;
}

namespace {

bool isPin(SectionKind section) {
  return section == SectionKind::Input || section == SectionKind::InOut || section == SectionKind::Output;
}

}  // namespace

std::span<const VarId> pinsOf(Context& context, PouId id) {
  Pou& pou = context.symbols.pou(id);
  if (!pou.progress.pins_ready) {
    resolvePou(context, id);
    pou.pins.clear();
    if (pou.base) {  // those of the base come first
      const std::span<const VarId> inherited = pinsOf(context, pou.base);
      pou.pins.assign(inherited.begin(), inherited.end());
    }
    for (const VarId var : pou.vars) {
      if (isPin(context.symbols.var(var).section)) pou.pins.push_back(var);
    }
    pou.progress.pins_ready = true;
  }
  return pou.pins;
}

namespace {

const char* kindName(AccessLevel access) {
  switch (access) {
    case AccessLevel::Private: return "PRIVATE";
    case AccessLevel::Protected: return "PROTECTED";
    case AccessLevel::Internal: return "INTERNAL";
    case AccessLevel::None:
    case AccessLevel::Public: break;
  }
  return "PUBLIC";
}

}  // namespace

bool mayAccess(Context& context, AccessLevel access, PouId owner, NameId name, Loc loc) {
  const bool of_interface = context.symbols.pou(owner).kind == PouKind::Interface;
  if (access == AccessLevel::None && !context.profile().public_members && !of_interface)
    access = AccessLevel::Protected;
  if (access == AccessLevel::None || access == AccessLevel::Public) return true;
  const bool same_project = context.library || !context.symbols.pou(owner).library;
  if (access == AccessLevel::Internal && same_project && isInside(context, context.scopes.pous[owner.index].region))
    return true;
  const PouId object = objectOf(context);
  if (object == owner) return true;
  if (access == AccessLevel::Protected && object && isKindOf(context, object, owner)) return true;
  context.report(diag::NotAccessible, loc,
                 {string(context, name), kindName(access), string(context, context.symbols.pou(owner).name)});
  return false;
}

// Forbids instances of an ABSTRACT type.   fails   VAR s : Shape; END_VAR (ABSTRACT)      E0356
bool checkNotAbstract(Context& context, TypeId type, Loc loc) {
  while (context.types().kind(type) == TypeKind::Array) type = context.types().info(context.types().resolve(type)).base;
  const PouId pou = context.types().kind(type) == TypeKind::Record ? pouOf(context, type) : PouId{};
  if (!pou || (context.symbols.pou(pou).object.modifiers & kAbstract) == 0) return true;
  context.report(diag::AbstractInstance, loc, {string(context, context.symbols.pou(pou).name)});
  return false;
}

}  // namespace rung::sema
