// SPDX-License-Identifier: Apache-2.0
// Constant expressions, evaluated by the arithmetic kernel. In: checked expressions. Out: their values. Called by sema
// for bounds, labels and initial values, by lowering for what it need not compute at run time. A constant also keeps
// memory in the instance or list that declares it, so that it can be watched; code uses its value.
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

bool isOperand(const TypeTable& table, TypeId type) {
  const TypeKind kind = table.plainKind(type);
  return TypeTable::isElementary(kind) || isUntypedLiteral(kind);
}

// The walk over an expression. With a context it reports, calls functions and makes strings; without one, for lowering,
// an expression that needs this has no value.
class Fold {
 public:
  Fold(const Symbols& symbols, Context* context) : symbols_(symbols), table_(symbols.types), context_(context) {}

  // The value in the expression's type.
  std::optional<Value> value(ExprId id) {
    const auto value = uncut(id);
    if (!value || !uncutType(symbols_, id)) return value;
    return checked(types::convert(table_, *value, meaning(symbols_.tree, id).type), symbols_.tree.loc(id), {});
  }

  // The value of an intermediate result in its own type (intermediate.h), of other expressions in theirs.
  std::optional<Value> uncut(ExprId id) {
    const TypeId type = meaning(symbols_.tree, id).type;
    if (!type || type == types::kError || depth_ > kMaxDepth) return std::nullopt;
    ++depth_;
    const auto value = uncut(id, uncutType(symbols_, id));
    --depth_;
    return value;
  }

 private:
  std::optional<Value> uncut(ExprId id, TypeId native);
  std::optional<Value> operand(ExprId id, TypeId native);
  std::optional<Value> ofEntity(Entity found) const;
  std::optional<Value> ofConvert(ExprId id, TypeId native);
  std::optional<Value> convertString(const Value& value, TypeId type) const;
  std::optional<Value> ofUnary(const UnaryExpr& node, TypeId native);
  std::optional<Value> ofBinary(const BinaryExpr& node, TypeId native);
  std::optional<Value> apply(Op op, Value left, Value right, Loc loc, Loc divisor);
  std::optional<Value> checked(const Outcome& outcome, Loc loc, Loc divisor);

  std::optional<Value> ofCall(ExprId id);
  std::optional<Value> ofChoice(const Call& call, TypeId type, bool select);
  std::optional<Value> ofFunction(PouId function, std::vector<Value> values);
  std::optional<Value> ofOperator(const CallExpr& node, const Call& call, const std::vector<Value>& operands);
  std::optional<Value> compared(Op op, const std::vector<Value>& operands, Loc loc);
  TypeId operandType(ExprId id, const Call& call) const;

  const Symbols& symbols_;
  const TypeTable& table_;
  Context* context_;
  uint32_t depth_ = 0;
};

std::optional<Value> Fold::uncut(ExprId id, TypeId native) {
  const Tree& tree = symbols_.tree;
  const ExprKind kind = tree.kind(id);
  switch (shape(kind)) {
    case ExprShape::Leaf:
      return kind == ExprKind::Literal ? valueOf(symbols_, tree.as<LiteralExpr>(id))
                                       : ofEntity(meaning(tree, id).entity);
    case ExprShape::Step: return kind == ExprKind::Member ? ofEntity(meaning(tree, id).entity) : std::nullopt;
    case ExprShape::Operation:
      if (kind == ExprKind::Unary) return ofUnary(tree.as<UnaryExpr>(id), native);
      if (kind == ExprKind::Binary) return ofBinary(tree.as<BinaryExpr>(id), native);
      return kind == ExprKind::Call && context_ != nullptr ? ofCall(id) : std::nullopt;
    case ExprShape::Inserted: return kind == ExprKind::Convert ? ofConvert(id, native) : std::nullopt;
    case ExprShape::Initializer: return std::nullopt;
  }
  return std::nullopt;
}

// An operand of an operation that computes in the type `native`; none: in the operands' own.
std::optional<Value> Fold::operand(ExprId id, TypeId native) {
  const auto value = native ? uncut(id) : this->value(id);
  return value && native ? types::convert(table_, *value, native).value : value;
}

// The value of an item of an enumeration, or of a constant.
std::optional<Value> Fold::ofEntity(Entity found) const {
  if (found.entityKind() == EntityKind::EnumValue) {
    const EnumValue& item = symbols_.enum_values[found.index];
    return Value{item.type, static_cast<uint64_t>(item.value)};
  }
  if (found.entityKind() != EntityKind::Var) return std::nullopt;
  const Var* var = &symbols_.vars[found.index];
  if (var->external) var = &symbols_.var(var->external);
  if (!var->constant || !var->has_value) return std::nullopt;
  return var->value;
}

std::optional<Value> Fold::ofConvert(ExprId id, TypeId native) {
  const auto value = uncut(symbols_.tree.as<ConvertExpr>(id).operand);
  if (!value) return std::nullopt;
  if (native) return types::convert(table_, *value, native).value;
  const Meaning& known = meaning(symbols_.tree, id);
  if (TypeTable::isString(table_.plainKind(value->type))) return convertString(*value, known.type);
  if (!TypeTable::isScalar(table_.plainKind(known.type))) return std::nullopt;
  return types::convert(table_, *value, known.type, roundingOf(known)).value;
}

// A string as one of another kind or length. None: the conversion needs the library.
std::optional<Value> Fold::convertString(const Value& value, TypeId type) const {
  const TypeKind from = table_.plainKind(value.type), to = table_.plainKind(type);
  const std::string_view text = symbols_.names.string(NameId{static_cast<uint32_t>(value.bits)});
  const uint32_t capacity = table_.info(table_.resolve(type)).length;
  if (from == to && text.size() <= capacity) return Value{type, value.bits};
  if (context_ == nullptr) return std::nullopt;
  if (from == TypeKind::String && to == TypeKind::WString)
    return isUtf8(text) ? std::optional(Value{type, value.bits}) : std::nullopt;
  if (from != to) return std::nullopt;
  if (to == TypeKind::WString) return Value{type, value.bits};
  size_t taken = capacity;
  while (to == TypeKind::UString && taken > 0 && (static_cast<unsigned char>(text[taken]) & 0xc0) == 0x80) --taken;
  return Value{type, context_->names().intern(text.substr(0, taken)).index};
}

std::optional<Value> Fold::ofUnary(const UnaryExpr& node, TypeId native) {
  const auto value = operand(node.operand, native);
  if (!value || !isOperand(table_, value->type)) return std::nullopt;
  if (TypeTable::isString(table_.plainKind(value->type))) return std::nullopt;
  if (node.op() == UnaryOp::Plus) return value;
  return apply(node.op() == UnaryOp::Not ? Op::Not : Op::Neg, *value, *value, node.h.loc, {});
}

std::optional<Value> Fold::ofBinary(const BinaryExpr& node, TypeId native) {
  const Op op = operatorOf(node.op());
  const TypeId type = types::isComparison(op) ? comparedType(symbols_, node.left, node.right) : native;
  const auto left = operand(node.left, type);
  if (!left) return std::nullopt;
  const auto right = operand(node.right, type);
  if (!right) return std::nullopt;
  return apply(op, *left, *right, node.h.loc, symbols_.tree.begin(node.right));
}

std::optional<Value> Fold::apply(Op op, Value left, Value right, Loc loc, Loc divisor) {
  if (!isOperand(table_, left.type) || !isOperand(table_, right.type)) return std::nullopt;
  const TypeKind a = table_.plainKind(left.type), b = table_.plainKind(right.type);
  const bool is_shift = types::isShift(op);
  if (a != b && !is_shift && op != Op::Power) {  // an untyped operand takes the type of the other
    if (isUntypedLiteral(a) && b != TypeKind::IntegerLiteral) {
      left = types::convert(table_, left, right.type).value;
    } else if (isUntypedLiteral(b)) {
      right = types::convert(table_, right, left.type).value;
    }
  }
  if (op == Op::Power && a == TypeKind::IntegerLiteral && TypeTable::isReal(b)) {
    left = types::convert(table_, left, right.type).value;
  }
  Outcome outcome = types::apply(table_, symbols_.names, op, left, right);
  if (op == Op::Mod && context_ != nullptr && context_->profile().modulo_by_zero_is_zero)
    outcome.fault = types::Fault::None;  // MOD by zero is 0
  return checked(outcome, loc, divisor);
}

// Forbids constant expressions that fault; warns of those that overflow.
//   fails   VAR CONSTANT n : INT := 1 / 0; END_VAR      E0323
std::optional<Value> Fold::checked(const Outcome& outcome, Loc loc, Loc divisor) {
  if (outcome.fault == types::Fault::Div) {
    if (context_ != nullptr) context_->report(diag::ConstantDivision, divisor);
    return std::nullopt;
  }
  if (outcome.overflow && context_ != nullptr) {
    context_->report(diag::ConstantOverflow, loc,
                     {table_.toString(outcome.value.type), types::toString(table_, symbols_.names, outcome.value)});
  }
  return outcome.value;
}

std::optional<Value> Fold::ofCall(ExprId id) {
  const CallExpr& node = symbols_.tree.as<CallExpr>(id);
  const Meaning& known = meaning(node.h);
  if (!known.call) return std::nullopt;
  const Call& call = symbols_.call(known.call);
  if (!call.pou || call.en || call.eno) return std::nullopt;
  if (call.kind != CallKind::Operator && call.kind != CallKind::Function) return std::nullopt;
  const OperatorKind kind = symbols_.pou(call.pou).pragmas.operator_kind;
  if (kind == OperatorKind::Select || kind == OperatorKind::Mux)
    return ofChoice(call, known.type, kind == OperatorKind::Select);
  const TypeId type = operandType(id, call);
  std::vector<Value> operands;
  for (const Binding& binding : call.bindings) {
    if (!binding.value || binding.is_output) return std::nullopt;
    const auto value = operand(binding.value, type);
    if (!value) return std::nullopt;
    operands.push_back(*value);
  }
  if (call.kind == CallKind::Function) return ofFunction(call.pou, std::move(operands));
  return operands.empty() ? std::nullopt : ofOperator(node, call, operands);
}

// In which the call computes with its operands; none: in their own.
TypeId Fold::operandType(ExprId id, const Call& call) const {
  const Pou::Pragmas& pragmas = symbols_.pou(call.pou).pragmas;
  TypeId type = uncutType(symbols_, id);
  if (pragmas.operator_kind != OperatorKind::Op || !types::isComparison(pragmas.op)) return type;
  for (const Binding& binding : call.bindings)
    if (binding.value && !type) type = uncutType(symbols_, binding.value);
  return type;
}

// SEL and MUX: only the chosen input.
std::optional<Value> Fold::ofChoice(const Call& call, TypeId type, bool select) {
  if (call.bindings.size() < 2 || !call.bindings[0].value) return std::nullopt;
  const auto selector = value(call.bindings[0].value);
  if (!selector) return std::nullopt;
  const uint64_t last = call.bindings.size() - 2;
  const uint64_t chosen = select ? uint64_t{selector->bits != 0} : std::min(selector->bits, last);
  const ExprId input = call.bindings[1 + chosen].value;
  const auto taken = input ? value(input) : std::nullopt;
  if (!taken || isUntypedLiteral(table_.kind(type)) || !TypeTable::isScalar(table_.plainKind(type))) return taken;
  return types::convert(table_, *taken, type).value;
}

// A function without effects except its result, run with a budget. IEC 61131-3 has no such constants: an extension.
std::optional<Value> Fold::ofFunction(PouId function, std::vector<Value> values) {
  const Pou& pou = symbols_.pou(function);
  const Options& options = context_->project.options;
  if (!options.call_constant || pou.generic) return std::nullopt;
  for (size_t i = 0; i < values.size(); ++i) {
    Value& value = values[i];
    if (!isOperand(table_, value.type)) return std::nullopt;
    if (!isUntypedLiteral(table_.kind(value.type))) continue;
    if (i >= pou.pins.size()) return std::nullopt;
    value = types::convert(table_, value, symbols_.var(pou.pins[i]).type).value;
  }
  return options.call_constant(context_->project, function, values, [&](PouId callee) {
    context_->symbols.pou(callee).body.affects_others = true;
    return context_->expressions->ensureBody(*context_, callee);
  });
}

std::optional<Value> Fold::ofOperator(const CallExpr& node, const Call& call, const std::vector<Value>& operands) {
  const Pou::Pragmas& pragmas = symbols_.pou(call.pou).pragmas;
  const Meaning& known = meaning(node.h);
  switch (pragmas.operator_kind) {
    case OperatorKind::Move: return operands[0];
    case OperatorKind::Convert:
      if (TypeTable::isString(table_.plainKind(operands[0].type)) || TypeTable::isString(table_.plainKind(known.type)))
        return std::nullopt;
      return types::convert(table_, operands[0], known.type, roundingOf(known)).value;
    case OperatorKind::Op: {
      if (types::operandCount(pragmas.op) == 1) return apply(pragmas.op, operands[0], operands[0], node.h.loc, {});
      if (types::isComparison(pragmas.op)) return compared(pragmas.op, operands, node.h.loc);
      std::optional<Value> result = operands[0];
      for (size_t i = 1; result && i < operands.size(); ++i)
        result = apply(pragmas.op, *result, operands[i], node.h.loc, symbols_.tree.begin(call.bindings[i].value));
      return result;
    }
    case OperatorKind::Select:
    case OperatorKind::Mux:
    case OperatorKind::None: return std::nullopt;
  }
  return std::nullopt;
}

// GT(a, b, c): a > b and b > c.
std::optional<Value> Fold::compared(Op op, const std::vector<Value>& operands, Loc loc) {
  bool all = true;
  for (size_t i = 1; i < operands.size(); ++i) {
    const auto pair = apply(op, operands[i - 1], operands[i], loc, {});
    if (!pair) return std::nullopt;
    all = all && pair->bits != 0;
  }
  return Value{types::kBool, all ? 1u : 0u};
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
  return negate != (literal.form.is_negative) ? -value : value;
}

}  // namespace

std::optional<Value> evaluate(Context& context, ExprId expr) { return Fold(context.symbols, &context).value(expr); }

static std::optional<Value> resolved(const Symbols& symbols, std::optional<Value> value) {
  if (value) value->type = symbols.types.resolve(value->type);
  return value;
}

std::optional<Value> constantOf(const Symbols& symbols, ExprId expr) {
  return resolved(symbols, Fold(symbols, nullptr).value(expr));
}

std::optional<Value> uncutConstant(const Symbols& symbols, ExprId expr) {
  return resolved(symbols, Fold(symbols, nullptr).uncut(expr));
}

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
