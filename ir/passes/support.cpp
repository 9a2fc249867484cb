// See support.h.
#include "ir/passes/support.h"

namespace rung::ir {

bool mayFault(const Body& body, ExprId root) {
  const Expr& e = body.expr(root);
  if (e.checks != 0) return true;
  bool found = false;
  forEachSlot(body, e, [&](const uint32_t& slot) { found = found || mayFault(body, ExprId{slot}); });
  return found;
}

std::vector<bool> privateLocals(const Module& module, const Body& body) {
  std::vector<bool> result(body.locals.size());
  for (size_t i = 0; i < body.locals.size(); ++i)
    result[i] = !body.locals[i].by_reference && !isAggregate(module.types, body.locals[i].type);
  auto expose = [&](ExprId place) {
    const Expr& root = body.expr(rootOf(body, place));
    if (root.kind == ExprKind::Local) result[root.a] = false;
  };
  for (const Expr& e : body.exprs)
    if (e.kind == ExprKind::Address) expose(ExprId{e.a});
  for (const Stmt& s : body.stmts)
    if (s.kind == StmtKind::Bind && s.b != 0) expose(ExprId{s.b});
  return result;
}

}  // namespace rung::ir
