// SPDX-License-Identifier: Apache-2.0
#include "sema/synthesized_nodes.h"

namespace rung::sema {

ExprId typed(Context& context, ExprId created, TypeId type) {
  context.type(created) = type;
  return created;
}

ExprId makeLiteral(Context& context, LiteralKind kind, TypeId type, int64_t value, Loc loc) {
  const ExprId created = context.build().literal(kind, static_cast<uint64_t>(value), loc);
  context.meaning(created).is_constant = true;
  return typed(context, created, type);
}

ExprId makeInteger(Context& context, TypeId type, __int128 value, Loc loc) {
  const ExprId created =
      makeLiteral(context, LiteralKind::Integer, type, static_cast<int64_t>(value < 0 ? -value : value), loc);
  if (value < 0) context.code().as<LiteralExpr>(created).form.is_negative = true;
  return created;
}

ExprId makeStringLiteral(Context& context, std::string_view text, Loc loc) {
  const ExprId created = context.build().text(LiteralKind::String, text, loc);
  context.meaning(created).is_constant = true;
  return typed(context, created, context.types().string(static_cast<uint32_t>(text.empty() ? 1 : text.size())));
}

ExprId makeName(Context& context, NameId name, Entity entity, Loc loc) {
  const ExprId created = context.build().name(name, loc);
  context.meaning(created).entity = entity;
  return created;
}

ExprId makeMember(Context& context, ExprId base, NameId name, Entity entity, Loc loc) {
  const ExprId created = context.build().member(base, name, loc);
  context.meaning(created).entity = entity;
  return created;
}

ExprId makeBinary(Context& context, BinaryOp op, ExprId left, ExprId right, TypeId type, Loc loc) {
  const ExprId created = context.build().binary(op, left, right, loc);
  context.code().expr(created).in_parens = 1;
  return typed(context, created, type);
}

ExprId makeDeref(Context& context, ExprId pointer, TypeId target, Loc loc) {
  const ExprId created = context.build().deref(pointer, loc);
  context.meaning(created).is_writable = true;
  return typed(context, created, target);
}

ExprId makeAddressOf(Context& context, ExprId lvalue, TypeId type, Loc loc) {
  return typed(context, context.build().addressOf(lvalue, loc), type);
}

}  // namespace rung::sema
