// SPDX-License-Identifier: Apache-2.0
// Nodes that sema adds to the tree, complete with their types: known values become literals, implicit operations
// expressions. In: operands that were checked. Out: a node that need not be checked again.

#include "sema/synthesized_nodes.h"

namespace rung::sema {

ExprId typed(Context& context, ExprId created, TypeId type) {
  context.tree().expr(created).type = type;
  return created;
}

ExprId makeLiteral(Context& context, LiteralKind kind, TypeId type, int64_t value, Loc loc) {
  const ExprId created = context.build().literal(kind, static_cast<uint64_t>(value), loc);
  context.tree().expr(created).is_constant = 1;
  return typed(context, created, type);
}

ExprId makeInteger(Context& context, TypeId type, __int128 value, Loc loc) {
  const ExprId created =
      makeLiteral(context, LiteralKind::Integer, type, static_cast<int64_t>(value < 0 ? -value : value), loc);
  if (value < 0) context.tree().expr(created).bits = kLiteralNegative;
  return created;
}

ExprId makeStringLiteral(Context& context, std::string_view text, Loc loc) {
  const ExprId created = context.build().text(LiteralKind::String, text, loc);
  context.tree().expr(created).is_constant = 1;
  return typed(context, created, context.types().string(static_cast<uint32_t>(text.empty() ? 1 : text.size())));
}

ExprId makeBinary(Context& context, BinaryOp op, ExprId left, ExprId right, TypeId type, Loc loc) {
  const ExprId created = context.build().binary(op, left, right, loc);
  context.tree().expr(created).in_parens = 1;
  return typed(context, created, type);
}

ExprId makeDeref(Context& context, ExprId pointer, TypeId target, Loc loc) {
  const ExprId created = context.build().deref(pointer, loc);
  context.tree().expr(created).writable = 1;
  return typed(context, created, target);
}

ExprId makeAddressOf(Context& context, ExprId lvalue, TypeId type, Loc loc) {
  return typed(context, context.build().addressOf(lvalue, loc), type);
}

}  // namespace rung::sema
