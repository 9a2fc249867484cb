// SPDX-License-Identifier: Apache-2.0
// Constant expressions, evaluated by the arithmetic kernel. In: checked expressions. Out: their values. A constant also
// keeps memory in the instance or list that declares it, so that it can be watched; code uses its value.
#include "sema/declarations/constants.h"

#include <algorithm>

#include "sema/declarations/diagnostics.h"
#include "sema/declarations/expressions.h"
#include "sema/intermediate.h"
#include "sema/project.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

using types::Op;
using types::Outcome;
using types::TypeKind;
using types::TypeTable;
using types::Value;

namespace {

constexpr uint32_t kMaxDepth = 2000;

bool isUntypedLiteral(TypeKind kind) { return kind == TypeKind::IntegerLiteral || kind == TypeKind::RealLiteral; }

}  // namespace

namespace {

// Forbids constant expressions that fault; warns of those that overflow.
//   fails   VAR CONSTANT n : INT := 1 / 0; END_VAR      E0323
std::optional<Value> checked(Context& context, const Outcome& outcome, Loc loc, Loc divisor) {
  if (outcome.fault == types::Fault::Div) {
    context.report(diag::ConstantDivision, divisor);
    return std::nullopt;
  }
  if (outcome.overflow) {
    context.report(diag::ConstantOverflow, loc,
                   {context.types().toString(outcome.value.type),
                    types::toString(context.types(), context.names(), outcome.value)});
  }
  return outcome.value;
}

std::optional<Value> evaluateAt(Context& context, ExprId id, uint32_t depth);
std::optional<Value> evaluateUncut(Context& context, ExprId id, uint32_t depth);

// An operand of an operation that computes in the type `native`; none: in the operands' own.
std::optional<Value> evaluateOperand(Context& context, ExprId id, TypeId native, uint32_t depth) {
  const auto value = native ? evaluateUncut(context, id, depth) : evaluateAt(context, id, depth);
  return value && native ? types::convert(context.types(), *value, native).value : value;
}

bool isOperand(const TypeTable& table, TypeId type) {
  const TypeKind kind = table.plainKind(type);
  return TypeTable::isElementary(kind) || isUntypedLiteral(kind);
}

std::optional<Value> applyChecked(Context& context, Op op, Value left, Value right, Loc loc, Loc divisor) {
  const TypeTable& table = context.types();
  if (!isOperand(table, left.type) || !isOperand(table, right.type)) return std::nullopt;
  const TypeKind a = table.plainKind(left.type), b = table.plainKind(right.type);
  const bool is_shift = types::isShift(op);
  if (a != b && !is_shift && op != Op::Power) {  // an untyped operand takes the type of the other
    if (isUntypedLiteral(a) && b != TypeKind::IntegerLiteral) {
      left = types::convert(table, left, right.type).value;
    } else if (isUntypedLiteral(b)) {
      right = types::convert(table, right, left.type).value;
    }
  }
  if (op == Op::Power && a == TypeKind::IntegerLiteral && TypeTable::isReal(b)) {
    left = types::convert(table, left, right.type).value;
  }
  Outcome outcome = types::apply(table, context.names(), op, left, right);
  if (op == Op::Mod && context.profile().modulo_by_zero_is_zero)
    outcome.fault = types::Fault::None;  // MOD by zero is 0
  return checked(context, outcome, loc, divisor);
}

// SEL and MUX: only the chosen input.
std::optional<Value> evaluateChoice(Context& context, const Call& call, TypeId type, bool select, uint32_t depth) {
  if (call.bindings.size() < 2 || !call.bindings[0].value) return std::nullopt;
  const auto selector = evaluateAt(context, call.bindings[0].value, depth + 1);
  if (!selector) return std::nullopt;
  const uint64_t last = call.bindings.size() - 2;
  const uint64_t chosen = select ? uint64_t{selector->bits != 0} : std::min(selector->bits, last);
  const ExprId input = call.bindings[1 + chosen].value;
  const auto value = input ? evaluateAt(context, input, depth + 1) : std::nullopt;
  if (!value || isUntypedLiteral(context.types().kind(type)) || !TypeTable::isScalar(context.types().plainKind(type))) {
    return value;
  }
  return types::convert(context.types(), *value, type).value;
}

// A function without effects except its result, run with a budget. IEC 61131-3 has no such constants: an extension.
std::optional<Value> callFunction(Context& context, PouId function, std::vector<Value> values) {
  Symbols& symbols = context.symbols;
  const Pou& pou = symbols.pou(function);
  if (!context.project.options.call_constant || pou.generic) return std::nullopt;
  for (size_t i = 0; i < values.size(); ++i) {
    Value& value = values[i];
    if (!isOperand(context.types(), value.type)) return std::nullopt;
    if (!isUntypedLiteral(context.types().kind(value.type))) continue;
    if (i >= pou.pins.size()) return std::nullopt;
    value = types::convert(context.types(), value, symbols.var(pou.pins[i]).type).value;
  }
  return context.project.options.call_constant(context.project, function, values, [&](PouId callee) {
    symbols.pou(callee).body.affects_others = true;
    return context.expressions->ensureBody(context, callee);
  });
}

std::optional<Value> evaluateCall(Context& context, ExprId id, uint32_t depth) {
  const CallExpr& node = context.tree().as<CallExpr>(id);
  if (!meaning(node.h).call) return std::nullopt;
  const Symbols& symbols = context.symbols;
  const Call& call = symbols.call(meaning(node.h).call);
  if (!call.pou || call.en || call.eno) return std::nullopt;
  if (call.kind != CallKind::Operator && call.kind != CallKind::Function) return std::nullopt;
  const Pou& pou = symbols.pou(call.pou);
  if (pou.pragmas.operator_kind == OperatorKind::Select || pou.pragmas.operator_kind == OperatorKind::Mux) {
    return evaluateChoice(context, call, meaning(node.h).type, pou.pragmas.operator_kind == OperatorKind::Select,
                          depth);
  }
  TypeId native = uncutType(context.symbols, id);
  const bool compares = pou.pragmas.operator_kind == OperatorKind::Op && types::isComparison(pou.pragmas.op);
  for (const Binding& binding : call.bindings)
    if (compares && binding.value && !native) native = uncutType(context.symbols, binding.value);
  std::vector<Value> operands;
  for (const Binding& binding : call.bindings) {
    if (!binding.value || binding.is_output) return std::nullopt;
    const auto value = evaluateOperand(context, binding.value, native, depth + 1);
    if (!value) return std::nullopt;
    operands.push_back(*value);
  }
  if (call.kind == CallKind::Function) return callFunction(context, call.pou, std::move(operands));
  if (operands.empty()) return std::nullopt;
  switch (pou.pragmas.operator_kind) {
    case OperatorKind::Move: return operands[0];
    case OperatorKind::Convert:
      if (TypeTable::isString(context.types().plainKind(operands[0].type)) ||
          TypeTable::isString(context.types().plainKind(meaning(node.h).type))) {
        return std::nullopt;
      }
      return types::convert(context.types(), operands[0], context.type(id), roundingOf(context.meaning(id))).value;
    case OperatorKind::Op: {
      if (types::operandCount(pou.pragmas.op) == 1)
        return applyChecked(context, pou.pragmas.op, operands[0], operands[0], node.h.loc, {});
      if (types::isComparison(pou.pragmas.op)) {  // GT(a, b, c): a > b and b > c
        bool all = true;
        for (size_t i = 1; i < operands.size(); ++i) {
          const auto pair = applyChecked(context, pou.pragmas.op, operands[i - 1], operands[i], node.h.loc, {});
          if (!pair) return std::nullopt;
          all = all && pair->bits != 0;
        }
        return Value{types::kBool, all ? 1u : 0u};
      }
      Value result = operands[0];
      for (size_t i = 1; i < operands.size(); ++i) {
        const Loc divisor = context.tree().begin(call.bindings[i].value);
        const auto next = applyChecked(context, pou.pragmas.op, result, operands[i], node.h.loc, divisor);
        if (!next) return std::nullopt;
        result = *next;
      }
      return result;
    }
    case OperatorKind::Select:
    case OperatorKind::Mux:
    case OperatorKind::None: return std::nullopt;
  }
  return std::nullopt;
}

// The value in the expression's type.
std::optional<Value> evaluateAt(Context& context, ExprId id, uint32_t depth) {
  const auto value = evaluateUncut(context, id, depth);
  if (!value || !uncutType(context.symbols, id)) return value;
  const ExprHeader& header = context.tree().expr(id);
  return checked(context, types::convert(context.types(), *value, meaning(header).type), header.loc, {});
}

// The value of an item of an enumeration, or of a constant.
std::optional<Value> valueOfEntity(const Context& context, Entity found) {
  if (found.entityKind() == EntityKind::EnumValue) {
    const EnumValue& item = context.symbols.enum_values[found.index];
    return Value{item.type, static_cast<uint64_t>(item.value)};
  }
  if (found.entityKind() != EntityKind::Var) return std::nullopt;
  const Var& var = context.symbols.vars[found.index];
  if (!var.constant || !var.has_value) return std::nullopt;
  return var.value;
}

// A string as one of another kind or length. None: the conversion needs the library.
std::optional<Value> convertString(Context& context, const Value& value, TypeId type) {
  const TypeKind from = context.types().plainKind(value.type), to = context.types().plainKind(type);
  const std::string_view text = context.names().string(NameId{static_cast<uint32_t>(value.bits)});
  if (from == TypeKind::String && to == TypeKind::WString)
    return isUtf8(text) ? std::optional(Value{type, value.bits}) : std::nullopt;
  if (from != to) return std::nullopt;
  const uint32_t capacity = context.types().info(context.types().resolve(type)).length;
  if (to == TypeKind::WString || text.size() <= capacity) return Value{type, value.bits};
  size_t taken = capacity;
  while (to == TypeKind::UString && taken > 0 && (static_cast<unsigned char>(text[taken]) & 0xc0) == 0x80) --taken;
  return Value{type, context.names().intern(text.substr(0, taken)).index};
}

std::optional<Value> evaluateConvert(Context& context, ExprId id, TypeId native, uint32_t depth) {
  const auto value = evaluateUncut(context, context.tree().as<ConvertExpr>(id).operand, depth + 1);
  if (!value) return std::nullopt;
  if (native) return types::convert(context.types(), *value, native).value;
  const TypeId type = context.type(id);
  if (TypeTable::isString(context.types().plainKind(value->type))) return convertString(context, *value, type);
  if (!TypeTable::isScalar(context.types().plainKind(type))) return std::nullopt;
  return types::convert(context.types(), *value, type, roundingOf(context.meaning(id))).value;
}

std::optional<Value> evaluateUnary(Context& context, const UnaryExpr& node, TypeId native, uint32_t depth) {
  const auto value = evaluateOperand(context, node.operand, native, depth + 1);
  if (!value || !isOperand(context.types(), value->type)) return std::nullopt;
  if (TypeTable::isString(context.types().plainKind(value->type))) return std::nullopt;
  if (node.op() == UnaryOp::Plus) return value;
  return applyChecked(context, node.op() == UnaryOp::Not ? Op::Not : Op::Neg, *value, *value, node.h.loc, {});
}

std::optional<Value> evaluateBinary(Context& context, const BinaryExpr& node, TypeId native, uint32_t depth) {
  const Op op = operatorOf(node.op());
  const TypeId type = types::isComparison(op) ? comparedType(context.symbols, node.left, node.right) : native;
  const auto left = evaluateOperand(context, node.left, type, depth + 1);
  if (!left) return std::nullopt;
  const auto right = evaluateOperand(context, node.right, type, depth + 1);
  if (!right) return std::nullopt;
  return applyChecked(context, op, *left, *right, node.h.loc, context.tree().begin(node.right));
}

// The value of an intermediate result in its own type (intermediate.h), of other expressions in theirs.
std::optional<Value> evaluateUncut(Context& context, ExprId id, uint32_t depth) {
  const Tree& tree = context.tree();
  const Meaning& known = context.meaning(id);
  if (!known.type || known.type == types::kError || depth > kMaxDepth) return std::nullopt;
  const TypeId native = uncutType(context.symbols, id);
  switch (tree.kind(id)) {
    case ExprKind::Literal: return valueOf(context.symbols, tree.as<LiteralExpr>(id));
    case ExprKind::Name:
    case ExprKind::TypedName:
    case ExprKind::Member: return valueOfEntity(context, known.entity);
    case ExprKind::Convert: return evaluateConvert(context, id, native, depth);
    case ExprKind::Unary: return evaluateUnary(context, tree.as<UnaryExpr>(id), native, depth);
    case ExprKind::Binary: return evaluateBinary(context, tree.as<BinaryExpr>(id), native, depth);
    case ExprKind::Call: return evaluateCall(context, id, depth);
    case ExprKind::Error:
    case ExprKind::Index:
    case ExprKind::This:
    case ExprKind::Super:
    case ExprKind::Deref:
    case ExprKind::BitAccess:
    case ExprKind::Address:
    case ExprKind::AddressOf:
    case ExprKind::Bound:
    case ExprKind::New:
    case ExprKind::Assign:
    case ExprKind::AnyValue:
    case ExprKind::Range:
    case ExprKind::ArrayInit:
    case ExprKind::Repeat:
    case ExprKind::StructInit: return std::nullopt;
  }
  return std::nullopt;
}

// A plain integer, as most bounds are: not checked as an expression.
std::optional<int64_t> plainInteger(const Tree& tree, ExprId id) {
  bool negate = false;
  if (tree.kind(id) == ExprKind::Unary && tree.as<UnaryExpr>(id).op() == UnaryOp::Negate) {
    id = tree.as<UnaryExpr>(id).operand;
    negate = true;
  }
  if (tree.kind(id) != ExprKind::Literal) return std::nullopt;
  const LiteralExpr& literal = tree.as<LiteralExpr>(id);
  if (literal.literal() != LiteralKind::Integer || literal.prefix || literal.high >> 31 != 0) return std::nullopt;
  const auto value = static_cast<int64_t>(literal.value());
  return negate != ((literal.h.bits & kLiteralNegative) != 0) ? -value : value;
}

}  // namespace

std::optional<Value> evaluate(Context& context, ExprId expr) { return evaluateAt(context, expr, 0); }

std::optional<Value> requireConstant(Context& context, ExprId expr, TypeId type) {
  if (context.type(expr) == types::kError) return std::nullopt;
  const uint32_t errors = context.symbols.diagnostics.errorCount();
  const auto value = evaluate(context, expr);
  if (!value) {
    if (context.symbols.diagnostics.errorCount() == errors) {
      context.report(diag::ConstantNeeded, context.tree().begin(expr));
    }
    return std::nullopt;
  }
  if (!type || type == types::kError || context.types().plain(type) == context.types().plain(value->type)) return value;
  if (!TypeTable::isScalar(context.types().plainKind(type)) || !isOperand(context.types(), value->type) ||
      TypeTable::isString(context.types().plainKind(value->type))) {
    return value;
  }
  return types::convert(context.types(), *value, type).value;
}

std::optional<int64_t> constantBound(Context& context, ExprId& expr) {
  if (const auto number = plainInteger(context.tree(), expr)) {
    context.replace(expr, makeInteger(context, types::idOf(TypeKind::LInt), *number, context.tree().loc(expr)));
    return number;
  }
  if (context.tree().kind(expr) == ExprKind::Error) return std::nullopt;
  const TypeId type = context.expressions->check(context, expr, {});
  if (type == types::kError) return std::nullopt;
  const TypeKind kind = context.types().plainKind(type);
  if (!TypeTable::isInteger(kind) && !TypeTable::isBits(kind) && kind != TypeKind::IntegerLiteral) {
    context.report(diag::IntegerNeeded, context.tree().begin(expr), {context.types().toString(type)});
    return std::nullopt;
  }
  const auto value = requireConstant(context, expr, {});
  if (!value) return std::nullopt;
  if (kind == TypeKind::ULInt || kind == TypeKind::LWord) {
    if (value->asSigned() < 0) {
      context.report(diag::ValueOutOfType, context.tree().begin(expr), {std::to_string(value->bits), "LINT"});
      return std::nullopt;
    }
  }
  return value->asSigned();
}

std::optional<int64_t> boundAsWritten(Context& context, ExprId written) {
  if (const auto number = plainInteger(context.tree(), written)) return number;
  return constantBound(context, codeOf(context, written));
}

}  // namespace rung::sema
