// SPDX-License-Identifier: Apache-2.0
// Objects in bodies: THIS and SUPER, calls of methods and actions, properties. In: names and members that mean one of
// these. Out: a sema::Call of kind Method; reading a property calls its GET, writing it calls its SET. Called by
// names.cpp, calls.cpp and statements.cpp.
#include "sema/bodies/objects.h"

#include <algorithm>

#include "frontend/syntax/inline_actions.h"
#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/names.h"
#include "sema/bodies/operators.h"
#include "sema/bodies/pointers.h"
#include "sema/bodies/required_pins.h"
#include "sema/bodies/statements.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/diagnostics.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

// The object that an instance expression names, as the owner of the called method: an interface pointer becomes one of
// the interface that declares the method.
ExprId instanceFor(Context& context, ExprId instance, PouId method) {
  if (!instance) return instance;
  const Pou& owner = context.symbols.pou(context.symbols.pou(method).owner);
  const types::TypeInfo& info = context.types().info(context.types().resolve(context.type(instance)));
  if (owner.kind != PouKind::Interface || info.kind != TypeKind::Record ||
      owner.record == context.types().resolve(context.type(instance)) ||
      context.tree().kind(instance) != ExprKind::Deref)
    return instance;
  ExprId pointer = context.tree().as<DerefExpr>(instance).base;
  wrapConvert(context, pointer, context.types().pointer(owner.record));
  return makeDeref(context, pointer, owner.record, context.tree().loc(pointer));
}

// The effect of a call on the variables that its object is reached through: a pointer is read, an object may change.
void markObject(Context& context, ExprId at) {
  Access access = Access::ReadWrite;
  const Tree& tree = context.tree();
  while (at) {
    const Entity entity = entityOf(context, at);
    if (entity.entityKind() == EntityKind::Var) markAccess(context, VarId{entity.index}, access, tree.loc(at));
    const ExprKind kind = tree.kind(at);
    if (kind == ExprKind::Deref) access = Access::Read;
    at = shape(kind) == ExprShape::Step && kind != ExprKind::BitAccess ? tree.base(at) : ExprId{};
  }
}

// Actions are virtual as methods are, except with {attribute 'no_virtual_actions'} at their block. Those that a chart
// has for itself, in its steps, transitions and inner charts, belong to that chart.
bool isFixedAction(const Context& context, const Pou& callee) {
  if (callee.kind != PouKind::Action) return false;
  const bool of_chart = callee.chart || callee.result || isInlineAction(context.tree(), context.names(), callee.decl);
  return of_chart || context.symbols.pou(callee.owner).pragmas.no_virtual_actions;
}

CallId addMethodCall(Context& context, PouId method, ExprId instance, std::vector<Binding>&& bindings) {
  const Pou& callee = context.symbols.pou(method);
  const Pou& owner = context.symbols.pou(callee.owner);
  Call call;
  call.kind = CallKind::Method;
  call.pou = method;
  call.instance = instanceFor(context, instance, method);
  call.bindings = std::move(bindings);
  const bool fixed = isFixedAction(context, callee) || !owner.object.dispatched ||
                     callee.access == AccessLevel::Private ||
                     ((callee.object.modifiers | owner.object.modifiers) & kFinal) != 0;
  call.is_virtual = !fixed && !(instance && isExact(context, instance));
  return addCall(context, std::move(call));
}

}  // namespace

namespace {

// Forbids THIS and SUPER outside of objects; in the initial values of a structure's members THIS is the structure.
//   fails   FUNCTION f … x := THIS^.y;       E0550
PouId wantObject(Context& context, Loc loc, const char* word) {
  const PouId object = objectOf(context);
  if (object && context.symbols.pou(object).kind != PouKind::Program) return object;
  context.report(diag::ThisOutside, loc, {word});
  return {};
}

TypeId checkThis(Context& context, ExprId expr) {
  ExprHeader& header = context.code().expr(expr);
  if (context.record) return meaning(header).type = context.types().pointer(context.record);
  const PouId object = wantObject(context, header.loc, "THIS");
  if (!object) return meaning(header).type = types::kError;
  return meaning(header).type = context.types().pointer(context.symbols.pou(object).record);
}

// Forbids SUPER where there is no base.   fails   FUNCTION_BLOCK a … SUPER^.m();       E0551
TypeId checkSuper(Context& context, ExprId expr) {
  ExprHeader& header = context.code().expr(expr);
  const PouId object = wantObject(context, header.loc, "SUPER");
  if (!object) return meaning(header).type = types::kError;
  const PouId base = context.symbols.pou(object).base;
  if (!base) {
    if (context.tree().as<PouDecl>(context.symbols.pou(object).decl).bases.empty())
      context.report(diag::SuperWithoutBase, header.loc, {string(context, context.symbols.pou(object).name)});
    return meaning(header).type = types::kError;
  }
  return meaning(header).type = context.types().pointer(context.symbols.pou(base).record);
}

}  // namespace

TypeId checkThisOrSuper(Context& context, ExprId& expr, TypeId expected, Access access) {
  const bool is_this = context.tree().kind(expr) == ExprKind::This;
  const NameId name = context.names().intern(is_this ? "THIS" : "SUPER");
  const Entity found = lookUp(context, name);
  if (found.entityKind() != EntityKind::Var || context.symbols.vars[found.index].type == types::kError)
    return is_this ? checkThis(context, expr) : checkSuper(context, expr);
  const ExprId created = context.build().name(name, context.tree().loc(expr));
  context.code().expr(created).in_parens = context.code().expr(expr).in_parens;
  context.replace(expr, created);
  return checkName(context, expr, expected, access);
}

TypeId throughObject(Context& context, ExprId& expr, TypeId type) {
  if (!type || type == types::kError) return type;
  const ExprKind kind = context.tree().kind(expr);
  if (kind != ExprKind::This && kind != ExprKind::Super && !interfaceOf(context, type)) return type;
  const TypeId target = context.types().info(context.types().resolve(type)).base;
  context.replace(expr, makeDeref(context, expr, target, context.tree().loc(expr)));
  return target;
}

bool isExact(const Context& context, ExprId instance) {
  const Tree& tree = context.tree();
  while (tree.kind(instance) == ExprKind::Index) instance = tree.base(instance);
  const ExprKind kind = tree.kind(instance);
  if (kind == ExprKind::Deref) return tree.kind(tree.base(instance)) == ExprKind::Super;
  if (kind != ExprKind::Name && kind != ExprKind::Member) return false;
  const Entity entity = entityOf(context, instance);
  return entity.entityKind() != EntityKind::Var || context.symbols.vars[entity.index].section != SectionKind::InOut;
}

namespace {

// A property with inherited accessors where it has none of its own.
Property accessorsOf(Context& context, uint32_t index) {
  Property property = context.symbols.properties[index];
  const auto inherit = [&](PouId base) {
    const Entity found = findInObject(context, base, property.name);
    if (found.entityKind() != EntityKind::Property) return;
    const Property other = accessorsOf(context, found.index);
    if (!property.get) property.get = other.get;
    if (!property.set) property.set = other.set;
  };
  const Pou& owner = context.symbols.pou(property.owner);
  if (property.get && property.set) return property;
  if (owner.base) inherit(owner.base);
  if (owner.kind == PouKind::Interface)
    for (const PouId base : std::vector<PouId>(owner.object.interfaces)) inherit(base);
  return property;
}

}  // namespace

TypeId useMember(Context& context, ExprId& expr, Entity member, ExprId instance, Access access) {
  const Loc loc = context.tree().loc(expr);
  ExprHeader& header = context.code().expr(expr);
  if (member.entityKind() == EntityKind::Pou) {
    const Pou& method = context.symbols.pou(PouId{member.index});
    if (!mayAccess(context, method.access, method.owner, method.name, loc)) return meaning(header).type = types::kError;
    if (access == Access::Qualifier) return meaning(header).type = {};
    context.report(diag::NotAValue, loc,
                   {string(context, method.name), method.kind == PouKind::Action ? "an action; call it with `()`"
                                                                                 : "a method; call it with `(...)`"});
    return meaning(header).type = types::kError;
  }
  noteMention(context, member, loc, access);
  const Property property = accessorsOf(context, member.index);
  const PouId accessor = property.get ? property.get : property.set;
  if (!accessor) {
    const bool writes_only = writesValue(access) && access != Access::Call;
    context.report(writes_only ? diag::PropertyWithoutSet : diag::PropertyWithoutGet, loc,
                   {string(context, property.name)});
    return meaning(header).type = types::kError;
  }
  resolvePou(context, accessor);
  const TypeId declared = property.get ? context.symbols.pou(property.get).result
                                       : context.symbols.var(pinsOf(context, property.set)[0]).type;
  // A value written to a REFERENCE goes to the variable that GET gives. An assignment handles the others; what else
  // writes needs a variable.
  const bool through = context.types().kind(declared) == TypeKind::Reference;
  const bool writes = writesValue(access) && access != Access::Call;
  if (access == Access::Bind || (writes && !through)) return meaning(header).type = declared;
  if (!property.get) {
    context.report(diag::PropertyWithoutGet, loc, {string(context, property.name)});
    return meaning(header).type = types::kError;
  }
  const Pou& getter = context.symbols.pou(property.get);
  if (!mayAccess(context, getter.access, getter.owner, property.name, loc)) return meaning(header).type = types::kError;
  noteCall(context, property.get, loc);
  const TypeId type = getter.result ? getter.result : types::kError;
  const ExprId call = context.build().call(expr, Slice<Argument>{}, loc, loc);
  context.meaning(call).call = addMethodCall(context, property.get, instance, {});
  meaning(header).type = {};
  context.replace(expr, typed(context, call, type));
  return type;
}

std::optional<TypeId> checkObjectMember(Context& context, ExprId& expr, PouId object, Access access, PouId method) {
  if (!object) return std::nullopt;
  MemberExpr& node = context.code().as<MemberExpr>(expr);
  const Entity found = method ? entity(method) : findInObject(context, object, node.member);
  if (found.entityKind() != EntityKind::Pou && found.entityKind() != EntityKind::Property) return std::nullopt;
  meaning(node.h).entity = found;
  markObject(context, node.base);
  return useMember(context, expr, found, node.base, access);
}

bool checkPropertyAssign(Context& context, AssignStmt& node) {
  const Entity found = entityOf(context, node.target);
  if (found.entityKind() != EntityKind::Property) return false;
  const Property property = accessorsOf(context, found.index);
  const Loc loc = context.tree().loc(node.target);
  noteMention(context, found, loc, Access::Write);
  if (!property.set) {
    context.report(diag::PropertyWithoutSet, loc, {string(context, property.name)});
    checkExpr(context, node.value);
    return true;
  }
  resolvePou(context, property.set);
  const Pou& setter = context.symbols.pou(property.set);
  const VarId pin = pinsOf(context, property.set)[0];
  const bool ok = mayAccess(context, setter.access, setter.owner, property.name, loc);
  const ExprId instance =
      context.tree().kind(node.target) == ExprKind::Member ? context.tree().as<MemberExpr>(node.target).base : ExprId{};
  const TypeId pin_type = context.symbols.var(pin).type;
  if (node.op() == AssignOp::Reference) {
    if (context.types().kind(pin_type) != TypeKind::Reference) return false;  // reported as for a variable
    if (!bindReference(context, node.value, pin_type)) return true;
    node.setOp(AssignOp::Assign);
  } else if (node.op() != AssignOp::Assign) {  // x.p += 1 reads it first
    ExprId read = context.code().duplicate(node.target);
    useMember(context, read, found, instance, Access::Read);
    context.replace(node.value, context.build().binary(binaryOf(node.op()), read, node.value, node.h.loc));
    node.setOp(AssignOp::Assign);
    const TypeId type = context.symbols.var(pin).type;
    check(context, context.code().as<BinaryExpr>(node.value).right, type, Access::Read);
    if (combine(context, node.value, type) == types::kError) return true;
    convert(context, node.value, type, Purpose{Use::Assigned, property.name, {}});
  } else {
    checkAs(context, node.value, context.symbols.var(pin).type, Purpose{Use::Assigned, property.name, {}});
  }
  if (!ok) return true;
  noteCall(context, property.set, loc);
  Binding binding;
  binding.pin = pin;
  binding.value = node.value;
  const ExprId call = context.build().call(node.target, Slice<Argument>{}, loc, loc);
  context.meaning(call).call = addMethodCall(context, property.set, instance, {binding});
  context.type(node.target) = {};
  context.replace(node.target, call);
  return true;
}

namespace {

constexpr uint32_t kImplicit = 2;  // bInitRetains, bInCopyCode of FB_Init

// Forbids FB_Init without the arguments that it needs.
Call constructorCall(Context& context, TypeId block, PouId method, Slice<Argument> given, Loc loc) {
  const std::span<const VarId> pins = pinsOf(context, method);
  std::vector<Argument> arguments;
  for (uint32_t i = 0; i < kImplicit; ++i)
    arguments.push_back({{}, makeLiteral(context, LiteralKind::Bool, types::kBool, 0, loc), false, false, loc});
  const auto isInput = [&](VarId pin) { return context.symbols.var(pin).section != SectionKind::Output; };
  const auto inputs = static_cast<size_t>(std::count_if(pins.begin(), pins.end(), isInput));
  for (const Argument& argument : context.tree().list(context.code().copy(given))) {
    if (!argument.pin.name && arguments.size() >= inputs) {
      context.report(diag::TooManyArguments, argument.value ? context.tree().begin(argument.value) : argument.loc,
                     {context.types().toString(block), std::to_string(inputs - kImplicit)});
      break;
    }
    arguments.push_back(argument);
  }
  CallExpr& node = context.code().as<CallExpr>(context.build().call({}, arguments, loc));
  const Arguments matched = matchArguments(context, node, method);
  Call call;
  call.kind = CallKind::Method;
  call.pou = method;
  bindArguments(context, node, method, matched, call);
  if (!matched.ok) return call;
  for (size_t i = kImplicit; i < pins.size(); ++i) {
    ensureInitialValue(context, pins[i]);
    const Var& pin = context.symbols.var(pins[i]);
    if ((i < matched.slots.size() && matched.slots[i] != 0) || pin.init || pin.section == SectionKind::Output) continue;
    context.report(diag::MissingArgument, loc, {context.types().toString(block), string(context, pin.name)});
    break;
  }
  return call;
}

uint64_t elementCount(const Context& context, TypeId type) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(type));
  if (info.kind != TypeKind::Array) return 1;
  uint64_t count = elementCount(context, info.base);
  for (const types::Dimension& dimension : info.dimensions) count *= dimension.count();
  return count;
}

}  // namespace

// Forbids arguments at a declaration that no FB_Init takes, and arrays with another number of lists than elements.
// Codesys.
//   passes  p : Pump(3);    a : ARRAY[0..1] OF Pump[(3), (4)];    FB_Init has an input after its two implicit ones
//   fails   a : ARRAY[0..2] OF Pump[(3), (4)];                                                        E0362
CallId checkConstructor(Context& context, TypeExprId type, uint32_t& elements) {
  const Tree& tree = context.tree();
  const TypeExprId whole = type;
  while (type && tree.kind(type) == TypeExprKind::Array) type = tree.as<ArrayTypeExpr>(type).element;
  if (!type || tree.kind(type) != TypeExprKind::Named) return {};
  const NamedTypeExpr& written = tree.as<NamedTypeExpr>(type);
  const TypeId resolved = context.types().resolve(typeAsWritten(context, type));
  if (!resolved || resolved == types::kError) return {};
  const PouId object = context.types().info(resolved).kind == TypeKind::Record ? pouOf(context, resolved) : PouId{};
  const PouId method = object ? constructorOf(context, object) : PouId{};
  const std::span<const VarId> pins = method ? pinsOf(context, method) : std::span<const VarId>();
  const std::span<const ExprId> lists = tree.list(written.elements);
  if (pins.size() <= kImplicit) {
    Slice<Argument> first = written.arguments;
    if (!lists.empty()) first = tree.as<CallExpr>(lists[0]).arguments;
    if (first.count > 0 && !isBroken(context, object))
      context.report(diag::TooManyArguments, tree.list(first)[0].loc, {context.types().toString(resolved), "0"});
    return {};
  }
  if (lists.empty())
    return addCall(context, constructorCall(context, resolved, method, written.arguments, written.h.loc));
  const uint64_t count = elementCount(context, typeAsWritten(context, whole));
  if (count != lists.size()) {
    context.report(diag::ElementArguments, tree.loc(lists[0]), {std::to_string(lists.size()), std::to_string(count)});
    return {};
  }
  std::vector<Call> calls;
  for (const ExprId list : lists)
    calls.push_back(constructorCall(context, resolved, method, tree.as<CallExpr>(list).arguments, tree.loc(list)));
  CallId first;
  for (Call& call : calls) {
    const CallId created = addCall(context, std::move(call));
    if (!first) first = created;
  }
  elements = static_cast<uint32_t>(calls.size());
  return first;
}

TypeId callMethod(Context& context, ExprId& expr, PouId id, ExprId instance, bool as_statement) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  bool checked = false;
  id = calledOf(context, node, id, checked);
  if (!id) return meaning(node.h).type = types::kError;
  // An action has the pins of its block (codesys): they are set before it runs and copied after.
  const bool is_action = context.symbols.pou(id).kind == PouKind::Action;
  const PouId has_pins = is_action ? context.symbols.pou(id).owner : id;
  resolvePou(context, has_pins);
  Arguments arguments = matchArguments(context, node, has_pins);
  arguments.checked = checked;
  const CallId created = addMethodCall(context, id, instance, {});
  Call call = context.symbols.call(created);
  bindControlPins(context, node, arguments, call);
  bindArguments(context, node, has_pins, arguments, call);
  if (arguments.ok && !is_action) checkRequiredPins(context, node, id, arguments);
  context.symbols.call(created) = std::move(call);
  meaning(node.h).call = created;
  const Pou& callee = context.symbols.pou(id);
  return resultOf(context, node, callee, as_statement);
}

}  // namespace rung::sema
