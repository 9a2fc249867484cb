// SPDX-License-Identifier: Apache-2.0
// ASSERT(cond [, 'text']), ASSERT_EQ(expected, actual [, 'text']), ASSERT_NEAR(expected, actual, tolerance [, 'text'])
// of tests. In: a call of one of these names that is not declared otherwise. Out: CallKind::Assertion
// with the operands in order, both sides brought to one type.
#include "sema/bodies/access.h"
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

static TypeId checkAssertion(Context& context, ExprId& expr, Assertion assertion) {
  CallExpr& node = context.code().as<CallExpr>(expr);
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
    return meaning(node.h).type = types::kError;
  }
  bool ok = true;
  if (assertion == Assertion::Assert) {
    ok = checkAs(context, operands[0], types::kBool, Purpose{Use::AssertCondition, {}, {}});
  } else {
    const TypeId first = check(context, operands[0], {}, Access::Read);
    const TypeId hint = isUntyped(context, first) ? TypeId{} : first;
    const TypeId second = check(context, operands[1], hint, Access::Read);
    if (second != types::kError && !isUntyped(context, second) && first != second && first != types::kError &&
        (entityOf(context, operands[0]).entityKind() == EntityKind::EnumValue ||
         context.tree().kind(operands[0]) == ExprKind::Literal)) {
      check(context, operands[0], second, Access::Read);  // T#1s beside an LTIME, an item of the other's enumeration
    }
    if (assertion == Assertion::AssertNear) {
      check(context, operands[2], first, Access::Read);
      for (uint32_t i = 0; i < 3; ++i) {
        ok = ok && context.type(operands[i]) != types::kError;
      }
      TypeId common = types::kReal;
      for (uint32_t i = 0; ok && i < 3; ++i) {
        const TypeId type = context.type(operands[i]);
        if (isUntyped(context, type)) continue;
        const TypeId with = commonNumber(context, common, type);
        if (!with) {
          context.report(diag::OperandType, context.tree().loc(operands[i]), {name, context.types().toString(type)});
          ok = false;
        } else {
          common = with;
        }
      }
      if (!types::TypeTable::isReal(context.types().plainKind(common))) common = types::kLReal;
      for (uint32_t i = 0; ok && i < 3; ++i)
        ok = convert(context, operands[i], common, Purpose{Use::ComparedByAssert, {}, {}});
    } else {
      ok = unify(context, std::span(operands).first(2), Operands::Equatable, {}, name, node.h.loc) != types::kError;
    }
  }
  if (operands.size() > needed) {
    ExprId& message = operands[needed];
    const TypeId type = check(context, message, {}, Access::Read);
    if (type == types::kError) {
      ok = false;
    } else if (context.types().plainKind(type) != TypeKind::String) {
      context.report(diag::AssertionMessage, context.tree().begin(message), {name, context.types().toString(type)});
      ok = false;
    }
  }
  for (uint32_t i = 0; i < node.arguments.count; ++i) context.code().list(node.arguments)[i].value = operands[i];
  if (!ok) return meaning(node.h).type = types::kError;
  Call call;
  call.kind = CallKind::Assertion;
  call.assertion = assertion;
  for (const ExprId operand : operands) {
    Binding binding;
    binding.value = operand;
    call.bindings.push_back(binding);
  }
  meaning(node.h).call = addCall(context, std::move(call));
  return meaning(node.h).type = {};
}

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
