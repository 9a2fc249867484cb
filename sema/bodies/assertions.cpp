// SPDX-License-Identifier: Apache-2.0
// ASSERT(cond [, 'text']), ASSERT_EQ(expected, actual [, 'text']), ASSERT_NEAR(expected, actual, tolerance [, 'text'])
// of tests. In: a call of one of these names that is not declared otherwise. Out: CallKind::Assertion
// with the operands in order, both sides brought to one type.
#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/names.h"
#include "sema/bodies/operators.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// Both sides of ASSERT_EQ and ASSERT_NEAR, each as the other one wants it.
TypeId checkSides(Context& context, std::span<ExprId> operands) {
  const TypeId first = check(context, operands[0], {}, Access::Read);
  const TypeId hint = isUntyped(context, first) ? TypeId{} : first;
  const TypeId second = check(context, operands[1], hint, Access::Read);
  if (second != types::kError && !isUntyped(context, second) && first != second && first != types::kError &&
      (entityOf(context, operands[0]).entityKind() == EntityKind::EnumValue ||
       context.tree().kind(operands[0]) == ExprKind::Literal)) {
    check(context, operands[0], second, Access::Read);  // T#1s beside an LTIME, an item of the other's enumeration
  }
  return first;
}

// Expected value, actual value and tolerance, as REAL or LREAL.
bool checkNear(Context& context, std::span<ExprId> operands, std::string_view name) {
  check(context, operands[2], checkSides(context, operands), Access::Read);
  for (const ExprId operand : operands)
    if (context.type(operand) == types::kError) return false;
  TypeId common = types::kReal;
  for (const ExprId operand : operands) {
    const TypeId type = context.type(operand);
    if (isUntyped(context, type)) continue;
    const TypeId with = commonNumber(context, common, type);
    if (!with) {
      context.report(diag::OperandType, context.tree().loc(operand), {name, context.types().toString(type)});
      return false;
    }
    common = with;
  }
  if (!types::TypeTable::isReal(context.types().plainKind(common))) common = types::kLReal;
  for (ExprId& operand : operands)
    if (!convert(context, operand, common, Purpose{Use::ComparedByAssert, {}, {}})) return false;
  return true;
}

bool checkOperands(Context& context, std::span<ExprId> operands, Assertion assertion, std::string_view name, Loc loc) {
  switch (assertion) {
    case Assertion::Assert: return checkAs(context, operands[0], types::kBool, Purpose{Use::AssertCondition, {}, {}});
    case Assertion::AssertEq:
      checkSides(context, operands);
      return unify(context, operands, Operands::Equatable, {}, name, loc) != types::kError;
    case Assertion::AssertNear: return checkNear(context, operands, name);
  }
  return false;
}

// The text that a failed assertion prints.
bool checkMessage(Context& context, ExprId& message, std::string_view name) {
  const TypeId type = check(context, message, {}, Access::Read);
  if (type == types::kError) return false;
  if (context.types().plainKind(type) == TypeKind::String) return true;
  context.report(diag::AssertionMessage, context.tree().begin(message), {name, context.types().toString(type)});
  return false;
}

TypeId checkAssertion(Context& context, ExprId& expr, Assertion assertion) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  Meaning& known = meaning(node.h);
  const uint32_t needed = assertion == Assertion::Assert ? 1 : assertion == Assertion::AssertEq ? 2 : 3;
  const std::string_view name = string(context, context.tree().as<NameExpr>(node.callee).name);
  std::vector<ExprId> operands;
  for (const Argument& argument : context.tree().list(node.arguments)) {
    if (argument.value && !argument.pin.name) operands.push_back(argument.value);
  }
  if (operands.size() != node.arguments.count || operands.size() < needed || operands.size() > needed + 1) {
    context.report(
        diag::WrongArgumentCount, node.h.loc,
        {name, std::to_string(needed) + " or " + std::to_string(needed + 1), std::to_string(operands.size())});
    checkLooseArguments(context, node);
    return known.type = types::kError;
  }
  bool ok = checkOperands(context, std::span(operands).first(needed), assertion, name, node.h.loc);
  if (operands.size() > needed) ok &= checkMessage(context, operands[needed], name);
  for (uint32_t i = 0; i < node.arguments.count; ++i) context.code().list(node.arguments)[i].value = operands[i];
  if (!ok) return known.type = types::kError;
  Call call;
  call.kind = CallKind::Assertion;
  call.assertion = assertion;
  for (const ExprId operand : operands) {
    Binding binding;
    binding.value = operand;
    call.bindings.push_back(binding);
  }
  known.call = addCall(context, std::move(call));
  return known.type = {};
}

}  // namespace

TypeId checkAssert(Context& context, ExprId& expr, const PseudoCall&) {
  return checkAssertion(context, expr, Assertion::Assert);
}

TypeId checkAssertEq(Context& context, ExprId& expr, const PseudoCall&) {
  return checkAssertion(context, expr, Assertion::AssertEq);
}

TypeId checkAssertNear(Context& context, ExprId& expr, const PseudoCall&) {
  return checkAssertion(context, expr, Assertion::AssertNear);
}

}  // namespace rung::sema
