// SPDX-License-Identifier: Apache-2.0
// SIZEOF and LEN_MAX: sizes that are known at compile time. Out: untyped literals.
#include "sema/access.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/pseudo_functions.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

// SIZEOF(x): a number of bytes, known at compile time.
TypeId checkSizeOf(Context& context, ExprId& expr, const PseudoCall& call) {
  const Loc loc = context.tree().loc(expr);
  ExprId operand = call.arguments[0].value;
  TypeId type;
  if (operand && context.tree().kind(operand) == ExprKind::Name) {
    type = context.types().elementary(context.tree().as<NameExpr>(operand).name);
  }
  if (!type && context.tree().kind(operand) == ExprKind::New) {  // SIZEOF(POINTER TO INT)
    NewExpr& node = context.code().as<NewExpr>(operand);
    if (node.only_type) type = meaning(node.h).type = resolveType(context, node.allocated);
  }
  if (!type) type = check(context, operand, {}, Access::Address);
  if (isUntyped(context, type)) type = finalizeUntyped(context, operand);
  if (!type || type == types::kError) return types::kError;
  if (const PouId pou = pouOf(context, type)) resolvePou(context, pou);
  if (!checkLayout(context, "SIZEOF", type, context.tree().begin(operand)) || !context.types().layout(type))
    return types::kError;
  const TypeId untyped = types::idOf(TypeKind::IntegerLiteral);
  const auto size = static_cast<int64_t>(context.types().info(context.types().resolve(type)).size);
  context.replace(expr, makeLiteral(context, LiteralKind::Integer, untyped, size, loc));
  return untyped;
}

// LEN_MAX(s): the declared capacity of the string, in bytes or 16-bit units. Edition 4.
TypeId checkLengthLimit(Context& context, ExprId& expr, const PseudoCall& call) {
  const Loc loc = context.tree().loc(expr);
  ExprId operand = call.arguments[0].value;
  const TypeId type = check(context, operand, {}, Access::Address);
  if (!type || type == types::kError) return types::kError;
  const types::TypeInfo& info = context.types().info(context.types().resolve(type));
  if (!types::TypeTable::isString(info.kind)) {
    context.report(diag::NotOfGeneric, context.tree().loc(operand),
                   {context.types().toString(type), string(context, call.name), "ANY_STRING"});
    return types::kError;
  }
  const TypeId untyped = types::idOf(TypeKind::IntegerLiteral);
  context.replace(expr, makeLiteral(context, LiteralKind::Integer, untyped, int64_t{info.length}, loc));
  return untyped;
}

}  // namespace rung::sema
