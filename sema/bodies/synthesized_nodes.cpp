// Nodes that sema adds to the tree, complete with their types: known values become literals, implicit operations
// expressions. In: operands that were checked. Out: a node that need not be checked again.
#include "sema/bodies/bodies.h"

namespace rung::sema {

ExprId makeLiteral(Context& context, LiteralKind kind, TypeId type, int64_t value, Loc loc) {
  LiteralExpr node{};
  node.h.kind = ExprKind::Literal;
  node.h.op = static_cast<uint8_t>(kind);
  node.h.loc = loc;
  node.h.is_constant = 1;
  node.h.type = type;
  node.setValue(static_cast<uint64_t>(value));
  return context.tree().add<ExprId>(node);
}

ExprId makeStringLiteral(Context& context, std::string_view text, Loc loc) {
  const TypeId type = context.types().string(static_cast<uint32_t>(text.empty() ? 1 : text.size()));
  const ExprId created = makeLiteral(context, LiteralKind::String, type, 0, loc);
  const StringId id = context.tree().addString(text);
  auto& node = context.tree().as<LiteralExpr>(created);
  node.low = id.first;
  node.high = id.length;
  return created;
}

ExprId makeBinary(Context& context, BinaryOp op, ExprId left, ExprId right, TypeId type, Loc loc) {
  BinaryExpr node{};
  node.h.kind = ExprKind::Binary;
  node.h.op = static_cast<uint8_t>(op);
  node.h.loc = loc;
  node.h.type = type;
  node.h.in_parens = 1;
  node.left = left;
  node.right = right;
  return context.tree().add<ExprId>(node);
}

ExprId makeDeref(Context& context, ExprId pointer, TypeId target, Loc loc) {
  DerefExpr node{};
  node.h.kind = ExprKind::Deref;
  node.h.loc = loc;
  node.h.writable = 1;
  node.h.type = target;
  node.base = pointer;
  return context.tree().add<ExprId>(node);
}

}  // namespace rung::sema
