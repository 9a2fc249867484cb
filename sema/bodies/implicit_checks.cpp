// SPDX-License-Identifier: Apache-2.0
// A project's own POUs for implicit checks, as CODESYS and TwinCAT call them: CheckBounds for array indices,
// CheckDivDInt and its kin for divisors, CheckRangeSigned and its kin for subranges, CheckPointer for `^`. In: a
// checked expression of a body of the project. Out: the expression in a call of the function, where the project has it
// with the documented declaration. Libraries, the functions themselves and POUs with {attribute 'no_check'} are not
// checked, nor are constants (CODESYS help, "POUs for Implicit Checks" and the page of each function). Rung's own check
// remains: it finds what the function lets pass.
#include "sema/bodies/implicit_checks.h"

#include <algorithm>

#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

using types::TypeTable;

struct Declaration {
  ImplicitCheck check;
  std::string_view name;
  std::string_view documented;  // in the message when the project's is different
  TypeId type;                  // of the result and of `inputs` inputs
  uint32_t inputs;
};
constexpr Declaration kDeclarations[] = {
    {ImplicitCheck::Bounds, "CheckBounds", "FUNCTION CheckBounds : DINT with the inputs index, lower, upper : DINT",
     types::kDInt, 3},
    {ImplicitCheck::DivDInt, "CheckDivDInt", "FUNCTION CheckDivDInt : DINT with the input divisor : DINT", types::kDInt,
     1},
    {ImplicitCheck::DivDInt, "CheckDivInt", "FUNCTION CheckDivInt : DINT with the input divisor : DINT", types::kDInt,
     1},
    {ImplicitCheck::DivLInt, "CheckDivLInt", "FUNCTION CheckDivLInt : LINT with the input divisor : LINT", types::kLInt,
     1},
    {ImplicitCheck::DivReal, "CheckDivReal", "FUNCTION CheckDivReal : REAL with the input divisor : REAL", types::kReal,
     1},
    {ImplicitCheck::DivLReal, "CheckDivLReal", "FUNCTION CheckDivLReal : LREAL with the input divisor : LREAL",
     types::kLReal, 1},
    {ImplicitCheck::RangeSigned, "CheckRangeSigned",
     "FUNCTION CheckRangeSigned : DINT with the inputs value, lower, upper : DINT", types::kDInt, 3},
    {ImplicitCheck::RangeUnsigned, "CheckRangeUnsigned",
     "FUNCTION CheckRangeUnsigned : UDINT with the inputs value, lower, upper : UDINT", types::kUDInt, 3},
    {ImplicitCheck::LRangeSigned, "CheckLRangeSigned",
     "FUNCTION CheckLRangeSigned : LINT with the inputs value, lower, upper : LINT", types::kLInt, 3},
    {ImplicitCheck::LRangeUnsigned, "CheckLRangeUnsigned",
     "FUNCTION CheckLRangeUnsigned : ULINT with the inputs value, lower, upper : ULINT", types::kULInt, 3},
};
constexpr std::string_view kPointerName = "CheckPointer";
constexpr std::string_view kPointerDeclaration =
    "FUNCTION CheckPointer : POINTER TO BYTE with the inputs ptToTest : POINTER TO BYTE; iSize, iGran : DINT; bWrite : "
    "BOOL";

bool hasInputs(Context& context, const Pou& pou, std::initializer_list<TypeId> wanted) {
  auto next = wanted.begin();
  for (const VarId id : pou.vars) {
    const Var& var = context.symbols.var(id);
    if (var.section == SectionKind::Output || var.section == SectionKind::InOut) return false;
    if (var.section != SectionKind::Input) continue;
    if (next == wanted.end() || context.types().resolve(var.type) != context.types().resolve(*next++)) return false;
  }
  return next == wanted.end();
}

bool isDocumented(Context& context, const Declaration& declaration, const Pou& pou) {
  const TypeId type = declaration.type;
  if (context.types().resolve(pou.result) != type) return false;
  return declaration.inputs == 1 ? hasInputs(context, pou, {type}) : hasInputs(context, pou, {type, type, type});
}

bool isCheckPointer(Context& context, const Pou& pou) {
  const TypeId bytes = context.types().pointer(types::idOf(TypeKind::Byte));
  return context.types().resolve(pou.result) == bytes &&
         hasInputs(context, pou, {bytes, types::kDInt, types::kDInt, types::kBool});
}

void take(Context& context, PouId id, ImplicitCheck check, bool is_documented, std::string_view documented) {
  const Pou& pou = context.symbols.pou(id);
  if (is_documented) {
    context.scopes.implicit_checks.functions[static_cast<size_t>(check)] = id;
  } else {
    context.report(diag::ImplicitCheckDeclaration, pou.loc, {string(context, pou.name), documented});
  }
}

// The functions of the project; each is resolved once, when the first body is checked.
void findImplicitChecks(Context& context) {
  context.scopes.implicit_checks.found = true;
  for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) {
    const Pou& pou = context.symbols.pous[i];
    const std::string_view name = string(context, pou.name);
    if (pou.library || pou.kind != PouKind::Function || pou.owner) continue;
    if (sameIdentifier(name, kPointerName)) {
      resolvePou(context, {i});
      take(context, {i}, ImplicitCheck::Pointer, isCheckPointer(context, pou), kPointerDeclaration);
    }
    for (const Declaration& declaration : kDeclarations) {
      if (!sameIdentifier(name, declaration.name)) continue;
      resolvePou(context, {i});
      take(context, {i}, declaration.check, isDocumented(context, declaration, pou), declaration.documented);
    }
  }
}

// The function for a check in the body of context.pou; none: nothing is called.
PouId functionFor(Context& context, ImplicitCheck check) {
  if (!context.profile().implicit_checks || context.body == nullptr || !context.pou) return {};
  if (!context.scopes.implicit_checks.found) findImplicitChecks(context);
  const PouId found = context.scopes.implicit_checks.functions[static_cast<size_t>(check)];
  if (!found) return {};
  const Pou& pou = context.symbols.pou(context.pou);
  if (pou.library || pou.pragmas.no_check || (pou.owner && context.symbols.pou(pou.owner).pragmas.no_check)) return {};
  const auto& all = context.scopes.implicit_checks.functions;
  return std::find(all.begin(), all.end(), context.pou) == all.end() ? found : PouId{};
}

// value := function(value, others…), in the type that the value has.
void wrapInCall(Context& context, PouId function, ExprId& value, TypeId type, std::initializer_list<ExprId> others) {
  const Loc loc = context.tree().loc(value);
  const TypeId given = context.type(value);
  ExprId passed = value;
  if (given != type) wrapConvert(context, passed, type);
  Call call;
  call.pou = function;
  const std::span<const VarId> pins = pinsOf(context, function);
  auto other = others.begin();
  for (size_t i = 0; i < pins.size(); ++i) {
    Binding binding;
    binding.pin = pins[i];
    binding.value = i == 0 ? passed : *other++;
    call.bindings.push_back(binding);
  }
  noteCall(context, function, loc);
  const ExprId name = makeName(context, context.symbols.pou(function).name, entity(function), loc);
  ExprId created = typed(context, context.build().call(name, Slice<Argument>{}, loc, loc), type);
  context.meaning(created).call = addCall(context, std::move(call));
  if (given != type) wrapConvert(context, created, given);
  context.replace(value, created);
}

bool isConstant(const Context& context, ExprId value) { return context.meaning(value).is_constant != 0; }

// The size of the largest scalar or string in a type: iGran of CheckPointer.
uint64_t granularity(const Context& context, TypeId type) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(type));
  if (info.kind == TypeKind::Array) return granularity(context, info.base);
  if (info.kind != TypeKind::Record) return info.size;
  uint64_t largest = 0;
  for (const types::Field& field : info.fields) largest = std::max(largest, granularity(context, field.type));
  return largest;
}

}  // namespace

void callBoundsCheck(Context& context, ExprId& index, const types::Dimension& dimension) {
  if (isConstant(context, index)) return;
  const PouId function = functionFor(context, ImplicitCheck::Bounds);
  if (!function) return;
  const Loc loc = context.tree().loc(index);
  wrapInCall(context, function, index, types::kDInt,
             {makeInteger(context, types::kDInt, dimension.low, loc),
              makeInteger(context, types::kDInt, dimension.high, loc)});
}

void callDivisorCheck(Context& context, ExprId& divisor) {
  const TypeKind kind = context.types().plainKind(context.type(divisor));
  if (isConstant(context, divisor) || !TypeTable::isNumber(kind)) return;
  const bool is_wide = TypeTable::bitWidth(kind) == 64;
  const bool is_real = TypeTable::isReal(kind);
  const PouId function = functionFor(context, is_real   ? is_wide ? ImplicitCheck::DivLReal : ImplicitCheck::DivReal
                                              : is_wide ? ImplicitCheck::DivLInt
                                                        : ImplicitCheck::DivDInt);
  if (function) wrapInCall(context, function, divisor, context.symbols.pou(function).result, {});
}

void callRangeCheck(Context& context, ExprId& value, TypeId subrange) {
  const types::TypeInfo& range = context.types().info(context.types().resolve(subrange));
  if (range.kind != TypeKind::Subrange || isConstant(context, value)) return;
  const TypeKind kind = context.types().plainKind(subrange);
  const bool is_wide = TypeTable::bitWidth(kind) == 64;
  const PouId function = functionFor(context, TypeTable::isSignedInteger(kind)
                                                  ? is_wide ? ImplicitCheck::LRangeSigned : ImplicitCheck::RangeSigned
                                              : is_wide ? ImplicitCheck::LRangeUnsigned
                                                        : ImplicitCheck::RangeUnsigned);
  if (!function) return;
  const Loc loc = context.tree().loc(value);
  const TypeId type = context.symbols.pou(function).result;
  wrapInCall(context, function, value, type,
             {makeInteger(context, type, range.low, loc), makeInteger(context, type, range.high, loc)});
}

void callPointerCheck(Context& context, ExprId& pointer, TypeId target, Access access) {
  const bool writes = writesValue(access);
  if (!writes && access != Access::Read) return;
  const PouId function = functionFor(context, ImplicitCheck::Pointer);
  const ExprKind kind = context.tree().kind(pointer);
  if (!function || kind == ExprKind::This || kind == ExprKind::Super || !ensureLayout(context, target)) return;
  const Loc loc = context.tree().loc(pointer);
  const uint64_t size = context.types().info(context.types().resolve(target)).size;
  wrapInCall(context, function, pointer, context.symbols.pou(function).result,
             {makeInteger(context, types::kDInt, size, loc),
              makeInteger(context, types::kDInt, granularity(context, target), loc),
              makeLiteral(context, LiteralKind::Bool, types::kBool, writes ? 1 : 0, loc)});
}

}  // namespace rung::sema
