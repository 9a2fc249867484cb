// SPDX-License-Identifier: Apache-2.0
// See support.h.
#include "ir/passes/support.h"

namespace rung::ir {

std::vector<bool> privateLocals(const Module& module, const Body& body) {
  std::vector<bool> result(body.locals.size());
  for (size_t i = 0; i < body.locals.size(); ++i)
    result[i] = !body.locals[i].by_reference && !isAggregate(module.types, body.locals[i].type);
  auto expose = [&](ExprId place) {
    if (const auto* root = body.expr(rootOf(body, place)).tryAs<LocalExpr>()) result[root->local] = false;
  };
  for (const Expr& e : body.exprs)
    if (const auto* address = e.tryAs<AddressExpr>()) expose(address->place);
  for (const Stmt& s : body.stmts)
    if (const auto* bind = s.tryAs<BindStmt>(); bind != nullptr && bind->place) expose(bind->place);
  return result;
}

}  // namespace rung::ir
