// SPDX-License-Identifier: Apache-2.0
// Assignment attempts: an object as a type that it may have, tested when the program runs. `target ?= source` of
// edition 3, __QUERYINTERFACE and __QUERYPOINTER of CODESYS. In: unchecked operands. Out: a sema::Call of kind Attempt.
// IEC 61131-3 ed. 3, 6.6.6.7, table 52.
#include "sema/bodies/attempts.h"

#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/bodies/writable.h"
#include "sema/declarations/objects.h"
#include "sema/hooks.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

constexpr const char* kObjectKinds = "an interface, a block, or a pointer or reference to a block";

// The object that a pointer type points to; none for other targets.
PouId pointedObject(Context& context, TypeId type) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(type));
  if (info.kind != TypeKind::Pointer && info.kind != TypeKind::Reference) return {};
  const PouId object = pouOf(context, info.base);
  return object && context.symbols.pou(object).kind != PouKind::Program ? object : PouId{};
}

// Forbids a source that is not an object.   fails   shape ?= 7;                              E0560
PouId checkSource(Context& context, ExprId& source, std::string_view word) {
  const TypeId type = check(context, source, {}, Access::Read);
  if (!type || type == types::kError) return {};
  if (const PouId object = pointedObject(context, type)) return object;
  const PouId object = context.types().kind(type) == TypeKind::Record ? pouOf(context, type) : PouId{};
  if (object && context.symbols.pou(object).kind != PouKind::Program) {
    context.replace(source, makeAddressOf(context, source, context.types().pointer(type), context.tree().loc(source)));
    return object;
  }
  context.report(diag::AttemptNeedsObject, context.tree().begin(source),
                 {word, kObjectKinds, context.types().toString(type)});
  return {};
}

// The variable that gets the object: an interface, a pointer, or the reference itself.
TypeId checkTaker(Context& context, ExprId& target) {
  const TypeId type = check(context, target, {}, Access::Write);
  if (!type || type == types::kError) return types::kError;
  if (context.tree().kind(target) == ExprKind::Deref) {
    const ExprId reference = context.tree().as<DerefExpr>(target).base;
    if (context.types().kind(context.type(reference)) == TypeKind::Reference) target = reference;
  }
  return checkWritable(context, target, Purpose{Use::Assigned, {}, {}}) ? context.type(target) : types::kError;
}

void refuseTaker(Context& context, ExprId target, TypeId type, std::string_view word, std::string_view wanted) {
  if (type == types::kError) return;
  context.report(diag::AttemptNeedsObject, context.tree().begin(target),
                 {word, wanted, context.types().toString(type)});
}

// `wanted`: the required type of the object; none: any.
ExprId makeAttempt(Context& context, ExprId source, PouId given, ExprId target, PouId wanted, Loc loc) {
  const TypeId type = context.type(target);
  Call call;
  call.kind = CallKind::Attempt;
  call.pou = wanted;
  if (wanted && isKindOf(context, given, wanted)) {  // true for every object of the declared type
    call.pou = {};
    if (given != wanted) wrapConvert(context, source, type);
  }
  context.rules->assignment(context, target, source);
  call.bindings.resize(2);
  call.bindings[0].value = source;
  call.bindings[1].value = target;
  const ExprId created = context.build().call(target, Slice<Argument>{}, loc, loc);
  context.meaning(created).call = addCall(context, std::move(call));
  return typed(context, created, types::kBool);
}

}  // namespace

void checkAttempt(Context& context, AssignStmt& node) {
  const TypeId type = checkTaker(context, node.target);
  const PouId wanted = type == types::kError ? PouId{} : pointedObject(context, type);
  if (!wanted) {  // two references to one type other than an object: an assignment. IEC 61131-3 ed. 3, 6.4.4.10.3
    const TypeId source = check(context, node.value, type, Access::Read);
    const TypeKind kind = context.types().kind(type);
    const bool is_reference = kind == TypeKind::Pointer || kind == TypeKind::Reference;
    if (is_reference && source && sameType(context, source, type))
      node.setOp(AssignOp::Assign);
    else if (source != types::kError)
      refuseTaker(context, node.target, type, "?=", kObjectKinds);
    return;
  }
  const PouId given = checkSource(context, node.value, "?=");
  if (!wanted || !given) return;
  const ExprId call = makeAttempt(context, node.value, given, node.target, wanted, node.h.loc);
  node.setOp(AssignOp::Assign);
  context.replace(node.target, call);
}

static TypeId checkQuery(Context& context, ExprId& expr, const PseudoCall& call, bool to_pointer) {
  const Loc loc = context.tree().loc(expr);
  ExprId source = call.arguments[0].value, target = call.arguments[1].value;
  const PouId given = checkSource(context, source, string(context, call.name));
  const TypeId type = checkTaker(context, target);
  const PouId wanted = type == types::kError ? PouId{} : pointedObject(context, type);
  const bool is_interface = wanted && context.symbols.pou(wanted).kind == PouKind::Interface;
  const bool is_pointer = type != types::kError && context.types().kind(type) == TypeKind::Pointer;
  if (to_pointer ? is_interface || !is_pointer : !is_interface) {
    refuseTaker(context, target, type, string(context, call.name), to_pointer ? "a pointer" : "an interface variable");
    return types::kError;
  }
  if (!given) return types::kError;
  context.replace(expr, makeAttempt(context, source, given, target, wanted, loc));
  return types::kBool;
}

TypeId checkQueryInterface(Context& context, ExprId& expr, const PseudoCall& call) {
  return checkQuery(context, expr, call, false);
}

TypeId checkQueryPointer(Context& context, ExprId& expr, const PseudoCall& call) {
  return checkQuery(context, expr, call, true);
}

}  // namespace rung::sema
