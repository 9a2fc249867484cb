// SPDX-License-Identifier: Apache-2.0
// Warns of a comparison of an integer variable with a literal that all values of its type decide alike. PLCopen coding
// rule CP2 for conditions of this kind; gcc has it as -Wtype-limits.
//   passes  IF speed > 100 THEN          speed : SINT
//   warns   IF speed = 200 THEN          speed : SINT          W0584
//   warns   WHILE count >= 0 DO          count : UINT          W0584
// An arithmetic expression has more values than its type in codesys, so variables and results of calls alone are looked
// at. Called for each comparison, infix or in call form.
#include "sema/bodies/expressions.h"
#include "sema/checks/rules.h"
#include "sema/shorthands.h"

#include <utility>

namespace rung::sema {
namespace {

using types::Op;
using types::TypeTable;

// Without the conversions to the common type of both sides, which keep the value.
ExprId withoutConversion(const Context& context, ExprId expr) {
  while (context.tree().kind(expr) == ExprKind::Convert) {
    const ExprId operand = context.tree().as<ConvertExpr>(expr).operand;
    const TypeId from = context.type(operand);
    if (!from || !types::isLossless(context.types(), from, context.type(expr))) break;
    expr = operand;
  }
  return expr;
}

bool isLiteral(const Context& context, ExprId expr) {
  if (context.tree().kind(expr) == ExprKind::Unary) {
    const UnaryExpr& node = context.tree().as<UnaryExpr>(expr);
    return node.op() == UnaryOp::Negate && isLiteral(context, node.operand);
  }
  return context.tree().kind(expr) == ExprKind::Literal;
}

bool isVariableOrCall(const Context& context, ExprId expr) {
  const ExprKind kind = context.tree().kind(expr);
  const bool has_storage = kind == ExprKind::Name || kind == ExprKind::Member || kind == ExprKind::Index ||
                           kind == ExprKind::Deref || kind == ExprKind::Call;
  return has_storage && !context.meaning(expr).is_constant;
}

Op mirrored(Op op) {
  if (op == Op::Lt) return Op::Gt;
  if (op == Op::Le) return Op::Ge;
  if (op == Op::Gt) return Op::Lt;
  return op == Op::Ge ? Op::Le : op;
}

// What each value from `low` to `high` says of `value op number`; none when they differ.
std::optional<bool> decided(Op op, __int128 low, __int128 high, __int128 number) {
  const auto all = [](bool always, bool never) {
    return always ? std::optional<bool>(true) : never ? std::optional<bool>(false) : std::nullopt;
  };
  const bool outside = number < low || number > high;
  if (op == Op::Eq) return all(false, outside);
  if (op == Op::Ne) return all(outside, false);
  if (op == Op::Lt) return all(high < number, low >= number);
  if (op == Op::Le) return all(high <= number, low > number);
  if (op == Op::Gt) return all(low > number, high <= number);
  return all(low >= number, high < number);
}

}  // namespace

void checkComparisonRange(Context& context, const Operation& operation) {
  Op op = operation.op;
  if (context.library) return;
  ExprId variable = withoutConversion(context, operation.left), number = withoutConversion(context, operation.right);
  if (isLiteral(context, variable)) {
    std::swap(variable, number);
    op = mirrored(op);
  }
  if (!isVariableOrCall(context, variable) || !isLiteral(context, number)) return;
  const TypeId type = context.type(variable);
  if (!type || type == types::kError || context.types().kind(type) == TypeKind::Enum) return;
  const TypeKind kind = context.types().plainKind(type);
  const TypeKind literal_kind = context.types().plainKind(context.type(number));
  if ((!TypeTable::isInteger(kind) && !TypeTable::isBits(kind)) || kind == TypeKind::Bool) return;
  if (!TypeTable::isInteger(literal_kind) && !TypeTable::isBits(literal_kind)) return;
  const std::optional<int64_t> bits = constantInteger(context, number);
  if (!bits) return;
  const __int128 value =
      context.types().isSigned(literal_kind) ? __int128{*bits} : __int128{static_cast<uint64_t>(*bits)};
  const uint32_t width = TypeTable::bitWidth(kind);
  const bool is_signed = context.types().isSigned(kind);
  const __int128 low = is_signed ? -(__int128{1} << (width - 1)) : 0;
  const __int128 high = (__int128{1} << (is_signed ? width - 1 : width)) - 1;
  const std::optional<bool> always = decided(op, low, high, value);
  if (!always) return;
  const auto text = [](__int128 n) {
    return n < 0 ? std::to_string(static_cast<int64_t>(n)) : std::to_string(static_cast<uint64_t>(n));
  };
  context.report(diag::ComparisonDecided, operation.loc,
                 {*always ? "TRUE" : "FALSE", context.types().toString(type), text(low), text(high)});
}

}  // namespace rung::sema
