// SPDX-License-Identifier: Apache-2.0
// Forbids objects that break the contract of their bases and interfaces: a missing method of an interface or an
// abstract base; an override with another signature; overriding a FINAL method; OVERRIDE without a method to override,
// and in edition 3 overriding without OVERRIDE; an abstract method in an object that is not ABSTRACT; a redeclared
// variable of the base, in iec also by a method; halves of a property that differ. IEC 61131-3 ed.
// 3, 6.6.5.5.4, 6.6.6.6.
//   passes  FUNCTION_BLOCK Pump IMPLEMENTS IDrive METHOD Start … END_METHOD
//   fails   FUNCTION_BLOCK Pump IMPLEMENTS IDrive (without Start)                    E0355
// Called once for each object of the project, when everything is declared.
#include "sema/checks/rules.h"

#include <algorithm>

#include "sema/bodies/conversions.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/fixes.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

PouId inherited(Context& context, PouId object, PouId like) {
  resolvePou(context, like);
  for (PouId at = object; at; at = context.symbols.pou(at).base) {
    if (context.symbols.pou(like).overloads.first)
      for (const PouId member : context.symbols.pou(at).members) resolvePou(context, member);
    if (const PouId found = methodLike(context.symbols, at, like)) return found;
  }
  return {};
}

std::string_view kindName(const Pou& member) {
  return member.object.accessor == AccessorKind::None  ? "method"
         : member.object.accessor == AccessorKind::Get ? "GET of the property"
                                                       : "SET of the property";
}

// Forbids an override that is less visible than the method of the base or interface.
//   fails   METHOD PRIVATE Start (PUBLIC in the base)                                    E0363
void checkAccess(Context& context, PouId method, PouId replaced) {
  const Pou& pou = context.symbols.pou(method);
  const Pou& other = context.symbols.pou(replaced);
  const bool hidden = pou.access == AccessLevel::Private || pou.access == AccessLevel::Protected;
  const bool of_interface = context.symbols.pou(other.owner).kind == PouKind::Interface;
  const bool shown = of_interface || other.access == AccessLevel::Public || other.access == AccessLevel::Internal ||
                     (other.access == AccessLevel::None && context.profile().public_members);
  const bool narrower =
      (hidden && shown) || (pou.access == AccessLevel::Private && other.access == AccessLevel::Protected);
  if (!narrower) return;
  context
      .report(diag::NarrowerAccess, pou.loc,
              {string(context, pou.name), pou.access == AccessLevel::Private ? "PRIVATE" : "PROTECTED",
               string(context, context.symbols.pou(other.owner).name)})
      .declaredHere(other.loc)
      .fix(otherWord(context, context.tree().decl(pou.decl).begin, pou.loc,
                     pou.access == AccessLevel::Private ? "PRIVATE" : "PROTECTED", "PUBLIC", Sureness::Proposal));
}

void checkSignature(Context& context, PouId method, PouId replaced) {
  resolvePou(context, method);
  resolvePou(context, replaced);
  const std::span<const VarId> pins = pinsOf(context, method), wanted = pinsOf(context, replaced);
  const Pou& pou = context.symbols.pou(method);
  const Pou& other = context.symbols.pou(replaced);
  std::string difference;
  if (pou.object.accessor == AccessorKind::Set) {  // GET has reported that the property is of another type
    for (const PouId member : context.symbols.pou(pou.owner).members)
      if (context.symbols.pou(member).object.accessor == AccessorKind::Get &&
          context.names().same(context.symbols.pou(member).name, pou.name))
        return;
  }
  const auto same = [&](TypeId a, TypeId b) {  // an unknown type was reported
    return a == types::kError || b == types::kError || sameType(context, a, b);
  };
  const auto toString = [&](TypeId type) { return type ? context.types().toString(type) : std::string("nothing"); };
  if (!pou.result != !other.result || (pou.result && !same(pou.result, other.result)))
    difference = other.result ? "the result is `" + toString(other.result) + "` there" : "there is no result there";
  for (size_t i = 0; difference.empty() && i < std::max(pins.size(), wanted.size()); ++i) {
    if (i >= wanted.size()) {
      difference = "there is no `" + std::string(string(context, context.symbols.var(pins[i]).name)) + "` there";
      continue;
    }
    const Var& there = context.symbols.var(wanted[i]);
    const std::string name(string(context, there.name));
    if (i >= pins.size() || context.symbols.var(pins[i]).section != there.section ||
        !context.names().same(context.symbols.var(pins[i]).name, there.name)) {
      difference = "the next parameter is `" + name + "` there";
    } else if (!same(context.symbols.var(pins[i]).type, there.type)) {
      difference = "`" + name + "` is `" + toString(there.type) + "` there";
    }
  }
  if (difference.empty()) checkAccess(context, method, replaced);
  if (difference.empty() || isBroken(context, method) || isBroken(context, replaced)) return;
  context
      .report(diag::OtherSignature, pou.loc,
              {string(context, pou.name), string(context, context.symbols.pou(other.owner).name), difference})
      .declaredHere(other.loc);
}

// Forbids an FB_Init without the two inputs that the system gives it, and one of a derived block without the further
// inputs of the base's in front of its own: the arguments of a declaration are passed to both. CODESYS, "FB_Init,
// FB_Reinit, FB_Exit"; TwinCAT, "Methods FB_init, FB_reinit and FB_exit".
//   passes  VAR_INPUT bInitRetains, bInCopyCode : BOOL; size : INT; name : STRING; END_VAR (size in the base too)
//   fails   VAR_INPUT size : INT; END_VAR                                                             E0779
constexpr size_t kGivenBySystem = 2;

bool isConstructor(const Context& context, const Pou& method) {
  return sameIdentifier(context.names().string(method.name), "FB_Init");
}

void checkConstructorInputs(Context& context, PouId id) {
  if (!isConstructor(context, context.symbols.pou(id)) || isBroken(context, id) || context.symbols.pou(id).library)
    return;
  resolvePou(context, id);
  const std::span<const VarId> pins = pinsOf(context, id);
  for (size_t i = 0; i < kGivenBySystem; ++i) {
    const Var* pin = i < pins.size() ? &context.symbols.var(pins[i]) : nullptr;
    if (pin != nullptr && pin->type == types::kError) return;
    if (pin != nullptr && pin->section == SectionKind::Input &&
        context.types().plainKind(pin->type) == types::TypeKind::Bool)
      continue;
    context.report(diag::ConstructorInputs, pin != nullptr ? pin->loc : context.symbols.pou(id).loc,
                   {context.names().string(context.symbols.pou(id).name)});
    return;
  }
}

void checkConstructorOfBase(Context& context, PouId id, PouId replaced) {
  const Pou& method = context.symbols.pou(id);
  if (!isConstructor(context, method) || isBroken(context, id) || isBroken(context, replaced) || method.library) return;
  resolvePou(context, replaced);
  const std::span<const VarId> pins = pinsOf(context, id), wanted = pinsOf(context, replaced);
  for (size_t i = kGivenBySystem; i < wanted.size(); ++i) {
    const Var& there = context.symbols.var(wanted[i]);
    const bool has_default = there.decl && context.tree().as<VarDecl>(there.decl).init;
    if (there.section == SectionKind::Output || (i >= pins.size() && has_default)) continue;
    const Var* pin = i < pins.size() ? &context.symbols.var(pins[i]) : nullptr;
    if (pin != nullptr && (pin->type == types::kError || there.type == types::kError)) return;
    if (pin != nullptr && pin->section == there.section && context.names().same(pin->name, there.name) &&
        sameType(context, pin->type, there.type))
      continue;
    context
        .report(diag::ConstructorOfBase, pin != nullptr ? pin->loc : method.loc,
                {string(context, method.name),
                 string(context, context.symbols.pou(context.symbols.pou(replaced).owner).name),
                 string(context, there.name), context.types().toString(there.type)})
        .declaredHere(there.loc);
    return;
  }
}

// The member as it is declared where it comes from, for another object.
std::string stubOf(const Context& context, PouId method, const std::string& indent) {
  const Tree& tree = context.tree();
  const Pou& pou = context.symbols.pou(method);
  const PouDecl& decl = tree.as<PouDecl>(pou.decl);
  const char* const access = context.profile().public_members ? "" : "PUBLIC ";
  std::string text = "\n" + indent + "METHOD " + access + toString(context, pou.name);
  if (decl.result) text += " : " + sourceText(context, tree.range(decl.result));
  for (const DeclId section : tree.list(decl.sections))
    text += "\n" + indent + sourceText(context, {tree.decl(section).begin, tree.decl(section).end});
  return text + "\n" + indent + "END_METHOD";
}

std::string stubOfProperty(const Context& context, PouId accessor, bool has_get, bool has_set,
                           const std::string& indent) {
  const Tree& tree = context.tree();
  const Pou& pou = context.symbols.pou(accessor);
  for (const DeclId member : tree.list(tree.as<PouDecl>(context.symbols.pou(pou.owner).decl).members)) {
    if (tree.kind(member) != DeclKind::Property) continue;
    const PropertyDecl& property = tree.as<PropertyDecl>(member);
    if (property.in_halves || !context.names().same(property.name, pou.name)) continue;
    return "\n" + indent + "PROPERTY " + toString(context, pou.name) + " : " +
           sourceText(context, tree.range(property.type)) + (has_get ? " GET END_GET" : "") +
           (has_set ? " SET END_SET" : "") + " END_PROPERTY";
  }
  return {};
}

// A member of the name is declared, another half of a property.
bool hasMember(const Context& context, PouId object, NameId name) {
  const std::span<const PouId> members = context.symbols.pou(object).members;
  return std::any_of(members.begin(), members.end(),
                     [&](PouId member) { return context.names().same(context.symbols.pou(member).name, name); });
}

Fix implemented(const Context& context, PouId object, const std::vector<PouId>& missing) {
  const Pou& pou = context.symbols.pou(object);
  const PouDecl& decl = context.tree().as<PouDecl>(pou.decl);
  const Loc at = decl.members.empty() ? endOfSections(context, decl)
                                      : context.tree().decl(context.tree().list(decl.members).back()).end;
  if (!isWholeSource(context, pou.loc)) return {};  // other tools keep each member apart
  const std::string indent = indentAt(context, pou.loc);
  std::string text, names;
  for (size_t i = 0; i < missing.size(); ++i) {
    const Pou& member = context.symbols.pou(missing[i]);
    const bool is_property = member.object.accessor != AccessorKind::None;
    const auto hasHalf = [&](AccessorKind half) {
      return std::any_of(missing.begin(), missing.end(), [&](PouId other) {
        const Pou& one = context.symbols.pou(other);
        return one.object.accessor == half && context.names().same(one.name, member.name);
      });
    };
    const bool has_get = hasHalf(AccessorKind::Get);
    if (is_property &&
        (hasMember(context, object, member.name) || (has_get && member.object.accessor == AccessorKind::Set)))
      continue;
    names += (names.empty() ? "`" : ", `") + toString(context, member.name) + "`";
    text += is_property ? stubOfProperty(context, missing[i], has_get, hasHalf(AccessorKind::Set), indent)
                        : stubOf(context, missing[i], indent);
  }
  return text.empty() ? Fix{} : Fix{"Implement " + names, {{at, at, text}}, false};
}

struct Demands {
  Context& context;
  PouId object;
  Loc loc;  // of the name that requires it
  std::vector<PouId> seen;
  std::vector<PouId> missing = {};

  void interface(PouId id) {
    if (std::find(seen.begin(), seen.end(), id) != seen.end()) return;
    seen.push_back(id);
    for (const PouId method : context.symbols.pou(id).members) demand(method);
    for (const PouId base : context.symbols.pou(id).object.interfaces) interface(base);
  }

  void demand(PouId method) {
    const Pou& wanted = context.symbols.pou(method);
    const PouId found = inherited(context, object, method);
    if (found && found != method) {
      if (context.symbols.pou(found).owner == object) checkSignature(context, found, method);
      return;
    }
    const Pou& pou = context.symbols.pou(object);
    if ((pou.object.modifiers & kAbstract) != 0 || isBroken(context, object)) return;
    missing.push_back(method);
    context
        .report(diag::MemberMissing, loc,
                {string(context, pou.name), kindName(wanted), string(context, wanted.name),
                 string(context, context.symbols.pou(wanted.owner).name)})
        .declaredHere(wanted.loc);
  }

  // All that are missing have one report: they have one location.
  void addFix() const {
    Diagnostic* const reported =
        missing.empty() ? nullptr : context.symbols.diagnostics.reportedAt(diag::MemberMissing, loc);
    if (reported != nullptr && reported->fixes.empty()) Report(reported).fix(implemented(context, object, missing));
  }
};

// Forbids statements in an interface.   fails   INTERFACE i METHOD m x := 1; END_METHOD …        E0364
void checkPrototypes(Context& context, PouId interface) {
  for (const PouId member : context.symbols.pou(interface).members) {
    const Pou& method = context.symbols.pou(member);
    const PouDecl& decl = context.tree().as<PouDecl>(method.decl);
    if (!decl.body.empty())
      context.report(diag::PrototypeWithBody, context.tree().loc(context.tree().list(decl.body)[0]),
                     {string(context, method.name), string(context, context.symbols.pou(interface).name)});
  }
}

void checkMethod(Context& context, PouId object, PouId id) {
  const Pou& method = context.symbols.pou(id);
  const Pou& owner = context.symbols.pou(object);
  if (method.kind != PouKind::Method) return;
  checkConstructorInputs(context, id);
  if ((method.object.modifiers & kAbstract) != 0 && (owner.object.modifiers & kAbstract) == 0) {
    context.report(diag::AbstractInConcrete, method.loc, {string(context, method.name), string(context, owner.name)});
    return;
  }
  if (owner.base && !context.profile().methods_named_as_variables) {
    const Entity first = findInObject(context, owner.base, method.name);
    if (first.entityKind() == EntityKind::Var)
      return reportTwice(context, method.name, method.loc, context.symbols.vars[first.index].loc);
  }
  const PouId replaced = owner.base ? inherited(context, owner.base, id) : PouId{};
  if (!replaced || context.symbols.pou(replaced).access == AccessLevel::Private) {
    if ((method.object.modifiers & kOverride) != 0)
      context.report(diag::OverridesNothing, method.loc, {string(context, method.name)})
          .fix(
              withoutWord(context, context.tree().decl(method.decl).begin, method.loc, "OVERRIDE", Sureness::Proposal));
    return;
  }
  const Pou& other = context.symbols.pou(replaced);
  const std::string_view base = string(context, context.symbols.pou(other.owner).name);
  const bool needs_override = context.symbols.profile.override_required;  // edition 2 lacks the word
  if ((other.object.modifiers & kFinal) != 0) {
    context.report(diag::OverridesFinal, method.loc, {string(context, method.name), base}).declaredHere(other.loc);
  } else if (isLifeMethod(context, method.name)) {
    checkConstructorOfBase(context, id, replaced);
  } else if (needs_override && (method.object.modifiers & kOverride) == 0) {
    context.report(diag::OverrideMissing, method.loc, {string(context, method.name), base})
        .insert(method.loc, "OVERRIDE ", Sureness::Sure);
  } else {
    checkSignature(context, id, replaced);
  }
}

// Forbids PROPERTY_GET and PROPERTY_SET of one name with different types or access specifiers. Edition 4.
//   passes  PROPERTY_GET PUBLIC Speed : INT … PROPERTY_SET PUBLIC Speed : INT …
//   fails   PROPERTY_GET Speed : INT … PROPERTY_SET Speed : REAL …                                           E0555
void checkHalves(Context& context, const Property& property) {
  const Pou& getter = context.symbols.pou(property.get);
  const Pou& setter = context.symbols.pou(property.set);
  const auto report = [&](const std::string& set, const std::string& get) {
    context.report(diag::PropertyHalves, setter.loc, {string(context, property.name), set, get})
        .declaredHere(getter.loc);
  };
  const TypeId read = getter.result, written = context.symbols.var(pinsOf(context, property.set)[0]).type;
  if (read == types::kError || written == types::kError) return;
  if (!sameType(context, read, written)) {
    report("`" + context.types().toString(written) + "`", "`" + context.types().toString(read) + "`");
  } else if (setter.access != getter.access) {
    const auto word = [](AccessLevel access) -> std::string {
      switch (access) {
        case AccessLevel::None: return "without an access specifier";
        case AccessLevel::Public: return "PUBLIC";
        case AccessLevel::Private: return "PRIVATE";
        case AccessLevel::Protected: return "PROTECTED";
        case AccessLevel::Internal: return "INTERNAL";
      }
      return {};
    };
    report(word(setter.access), word(getter.access));
  }
}

void checkHalves(Context& context, PouId object) {
  size_t index = 0;
  for (const DeclId member :
       context.tree().list(context.tree().as<PouDecl>(context.symbols.pou(object).decl).members)) {
    if (context.tree().kind(member) != DeclKind::Property) continue;
    const Property& property = context.symbols.properties[context.symbols.pou(object).object.properties[index++]];
    if (context.tree().as<PropertyDecl>(member).in_halves && property.get && property.set)
      checkHalves(context, property);
  }
}

}  // namespace

static void checkObject(Context& context, PouId object) {
  const Pou& pou = context.symbols.pou(object);
  checkHalves(context, object);
  if (pou.kind == PouKind::Interface) return checkPrototypes(context, object);
  const PouDecl& decl = context.tree().as<PouDecl>(pou.decl);
  for (const PouId member : pou.members) checkMethod(context, object, member);
  for (const TypeExprId written : context.tree().list(decl.implements)) {
    Demands demands{context, object, context.tree().loc(written), {}};
    if (const PouId interface = interfaceOf(context, typeAsWritten(context, written))) demands.interface(interface);
    demands.addFix();
  }
  if (!pou.base) return;
  const Loc base_loc = context.tree().loc(context.tree().list(decl.bases)[0]);
  for (PouId at = pou.base; at; at = context.symbols.pou(at).base) {
    Demands demands{context, object, base_loc, {}};
    for (const PouId method : context.symbols.pou(at).members)
      if ((context.symbols.pou(method).object.modifiers & kAbstract) != 0 &&
          inherited(context, object, method) == method)
        demands.demand(method);
    demands.addFix();
  }
  for (const VarId id : pou.vars) {
    const Var& var = context.symbols.var(id);
    if (!var.decl || !var.name || var.of_chart) continue;  // each of two charts has its own
    const Entity first = findInObject(context, pou.base, var.name);
    // The VAR_TEMP of a base is only known to its body and actions. CODESYS, "Extension of Function Blocks".
    if (first.entityKind() == EntityKind::Var && context.symbols.vars[first.index].section != SectionKind::Temp)
      reportTwice(context, var.name, var.loc, context.symbols.vars[first.index].loc);
  }
}

void checkObjectMembers(Context& context) {
  for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) {
    const Pou& pou = context.symbols.pous[i];
    if (pou.decl && !pou.owner && !pou.library) checkObject(context, PouId{i});
  }
}

}  // namespace rung::sema
