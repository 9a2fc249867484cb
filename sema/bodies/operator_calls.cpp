// SPDX-License-Identifier: Apache-2.0
// Operators in call form: ADD(a, b, c), SEL, MUX, MOVE, SHL … (library functions declared with {operator '…'}, which
// names an operator of the arithmetic kernel). In: a call of such a function. Out: CallKind::Operator with the operands
// in order, open ones without a value (they count as 0), or a BinaryExpr for times and dates, or a ConvertExpr for
// {operator 'convert'}.
#include "sema/bodies/operator_calls.h"

#include <optional>

#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversion_calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/division_by_zero.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/generic_calls.h"
#include "sema/bodies/implicit_checks.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/operators.h"
#include "sema/bodies/required_pins.h"
#include "sema/hooks.h"
#include "sema/intermediate.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

using types::TypeTable;

// The arithmetic operator that a function is; none: another one.
std::optional<BinaryOp> infixOf(types::Op op) {
  for (const BinaryOp infix :
       {BinaryOp::Add, BinaryOp::Subtract, BinaryOp::Multiply, BinaryOp::Divide, BinaryOp::Modulo, BinaryOp::Power})
    if (operatorOf(infix) == op) return infix;
  return std::nullopt;
}

bool isArithmetic(const auto& pragmas) {
  return pragmas.operator_kind == OperatorKind::Op && (pragmas.op == types::Op::Abs || infixOf(pragmas.op));
}

bool isTime(const Context& context, TypeId type) {
  const TypeKind kind = context.types().plainKind(type);
  return TypeTable::isDuration(kind) || TypeTable::isDate(kind);
}

// ADD(tod, t), MUL(t, 2): the same as the infix form. None when no operand is a time or date (then all are checked), or
// when one is left open.
TypeId infixTimes(Context& context, ExprId& expr, const Arguments& arguments, BinaryOp op, TypeId expected,
                  TypeId forced) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  bool times = false, open = false;
  std::vector<ExprId> operands;
  for (const uint32_t index : arguments.slots) {
    ExprId value;
    if (index != 0) value = context.tree().list(node.arguments)[index - 1].value;
    if (!value) {
      open = true;
      continue;
    }
    const TypeId type = check(context, value, {}, Access::Read);
    if (type == types::kError) return type;
    const bool first_only = op == BinaryOp::Multiply || op == BinaryOp::Divide;
    if (forced && isTime(context, forced) && (operands.empty() || !first_only)) {
      if (!convert(context, value, forced, Purpose{Use::Passed, context.tree().as<NameExpr>(node.callee).name, {}})) {
        return types::kError;
      }
    }
    if (!isUntyped(context, type)) times |= isTime(context, type);
    context.code().list(node.arguments)[index - 1].value = value;
    operands.push_back(value);
  }
  if (!times || open || operands.size() < 2) return {};
  ExprId value = operands[0];
  for (size_t i = 1; i < operands.size(); ++i) {
    value = makeBinary(context, op, value, operands[i], {}, node.h.loc);
    if (combine(context, value, expected) == types::kError) return types::kError;
  }
  expr = value;  // of checkOperatorCall, which puts it in place of the call
  return context.type(value);
}

// What EXPT, DIV and MOD ask of their operands. False: an error was reported.
bool checkOperation(Context& context, const CallExpr& node, types::Op op, std::vector<ExprId>& operands,
                    TypeId expected, TypeId& result) {
  if (op == types::Op::Power && operands.size() == 2 && operands[0] && operands[1]) {
    result = power(context, operands[0], operands[1], expected, node.h.loc);
    if (result == types::kError) return false;
  }
  if ((op == types::Op::Div || op == types::Op::Mod) && operands.size() > 1 && operands[1]) {
    if (!checkDivisor(context, operands[1], op == types::Op::Div ? BinaryOp::Divide : BinaryOp::Modulo)) return false;
    callDivisorCheck(context, operands[1]);
  }
  return true;
}

}  // namespace

TypeId checkOperatorCall(Context& context, ExprId& expr, PouId id, TypeId expected, TypeId forced) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  Meaning& known = meaning(node.h);
  const Pou& pou = context.symbols.pou(id);
  const Arguments arguments = matchArguments(context, node, id);
  if (!arguments.ok) {
    return checkRefused(context, node, arguments);
  }
  if (!checkRequiredPins(context, node, id, arguments)) return known.type = types::kError;
  const auto infix = pou.pragmas.operator_kind == OperatorKind::Op ? infixOf(pou.pragmas.op) : std::nullopt;
  const bool checked = infix && infix != BinaryOp::Power;
  if (checked) {
    ExprId value = expr;
    if (const TypeId type = infixTimes(context, value, arguments, *infix, expected, forced)) {
      if (type != types::kError && (arguments.en != 0 || arguments.eno != 0)) return guardValue(context, expr, value);
      context.replace(expr, value);
      return context.type(expr) = type;
    }
  }
  GenericOperands operands = groupOperands(context, node, id, arguments, expected, forced, checked);
  if (!operands.ok) return known.type = types::kError;
  TypeId result = pou.result ? operands.typeFor(context, pou.result) : types::kError;
  if (!result) result = expected ? expected : types::kDInt;
  if (pou.pragmas.operator_kind == OperatorKind::Op &&
      !checkOperation(context, node, pou.pragmas.op, operands.values, expected, result))
    return known.type = types::kError;
  if (pou.pragmas.operator_kind == OperatorKind::Convert && arguments.en == 0 && arguments.eno == 0) {
    ExprId value = operands.values.empty() ? ExprId{} : operands.values[0];
    if (!value) return known.type = types::kError;
    wrapConvert(context, value, forced ? forced : result);
    context.replace(expr, value);
    return context.type(expr);
  }
  Call call;
  call.kind = CallKind::Operator;
  call.pou = id;
  bindControlPins(context, node, arguments, call);
  for (const ExprId value : operands.values) {
    Binding binding;
    binding.value = value;
    call.bindings.push_back(binding);
  }
  bool constant = arguments.en == 0 && arguments.eno == 0;
  for (const ExprId value : operands.values) constant &= !value || context.meaning(value).is_constant;
  known.is_constant = constant;
  const bool is_conditional = arguments.en != 0 || arguments.eno != 0;
  markIntermediate(context.symbols, expr, result, context.isWide() && !is_conditional && isArithmetic(pou.pragmas));
  known.call = addCall(context, std::move(call));
  known.type = result;
  if (pou.pragmas.operator_kind == OperatorKind::Convert && operands.values[0])
    markRounding(context.symbols, expr, context.type(operands.values[0]), context.isWide());
  context.rules->expression(context, expr);
  return result;
}

}  // namespace rung::sema
