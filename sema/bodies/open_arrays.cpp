// SPDX-License-Identifier: Apache-2.0
// LOWER_BOUND and UPPER_BOUND. IEC 61131-3 ed. 3 table 16, 1 and 2. In: calls. Out: a literal for an array with fixed
// bounds, a BoundExpr for the ARRAY[*] of a VAR_IN_OUT, whose bounds are passed with the variable.
#include "sema/access.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

static TypeId checkBound(Context& context, ExprId& expr, const PseudoCall& call, bool upper) {
  const Loc loc = context.tree().loc(expr);
  const auto fail = [] { return types::kError; };
  ExprId array = call.arguments[0].value, number = call.arguments[1].value;
  const TypeId type = check(context, array, {}, Access::Read);
  if (checkExpr(context, number) == types::kError || type == types::kError || !type) return fail();
  const types::TypeInfo& info = context.types().info(context.types().resolve(type));
  if (info.kind != TypeKind::Array) {
    context.report(diag::NotAnArray, context.tree().begin(array), {context.types().toString(type)});
    return fail();
  }
  const uint32_t dimensions = info.dimensions.empty() ? info.length : static_cast<uint32_t>(info.dimensions.size());
  const std::optional<int64_t> dimension = constantInteger(context, number);
  if (!dimension || *dimension < 1 || *dimension > dimensions) {
    context.report(diag::BoundDimension, context.tree().begin(number),
                   {string(context, call.name), std::to_string(dimensions)});
    return fail();
  }
  const auto index = static_cast<uint32_t>(*dimension - 1);
  if (info.dimensions.empty()) {
    const ExprId bound = context.build().bound(array, 2 * index + (upper ? 1 : 0), loc);
    context.replace(expr, typed(context, bound, types::kDInt));
    return types::kDInt;
  }
  const int64_t value = upper ? info.dimensions[index].high : info.dimensions[index].low;
  context.replace(expr, makeInteger(context, types::kDInt, value, loc));
  return types::kDInt;
}

TypeId checkLowerBound(Context& context, ExprId& expr, const PseudoCall& call) {
  return checkBound(context, expr, call, false);
}

TypeId checkUpperBound(Context& context, ExprId& expr, const PseudoCall& call) {
  return checkBound(context, expr, call, true);
}

}  // namespace rung::sema
