// LOWER_BOUND and UPPER_BOUND. IEC 61131-3 ed. 3 table 16, 1 and 2. In: calls. Out: a literal for an array with fixed
// bounds, a BoundExpr for the ARRAY[*] of a VAR_IN_OUT, whose bounds are passed with the variable.
#include "sema/bodies/bodies.h"
#include "sema/bodies/diagnostics.h"

namespace rung::sema {

TypeId checkBoundCall(Context& context, ExprId& expr, NameId name) {
  const std::string_view word = string(context, name);
  const bool lower = sameIdentifier(word, "LOWER_BOUND"), upper = sameIdentifier(word, "UPPER_BOUND");
  if (!lower && !upper) return {};
  const CallExpr node = context.tree().as<CallExpr>(expr);
  const auto fail = [&] { return context.tree().expr(expr).type = types::kError; };
  if (node.arguments.count != 2) {
    context.report(diag::WrongArgumentCount, node.h.loc, {word, "2", std::to_string(node.arguments.count)});
    checkLooseArguments(context, node);
    return fail();
  }
  ExprId array = context.tree().list(node.arguments)[0].value, number = context.tree().list(node.arguments)[1].value;
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
    context.report(diag::BoundDimension, context.tree().begin(number), {word, std::to_string(dimensions)});
    return fail();
  }
  const auto index = static_cast<uint32_t>(*dimension - 1);
  if (info.dimensions.empty()) {
    const ExprId bound = context.build().bound(array, 2 * index + (upper ? 1 : 0), node.h.loc);
    context.replace(expr, typed(context, bound, types::kDInt));
    return types::kDInt;
  }
  const int64_t value = lower ? info.dimensions[index].low : info.dimensions[index].high;
  context.replace(expr, makeInteger(context, types::kDInt, value, node.h.loc));
  return types::kDInt;
}

}  // namespace rung::sema
