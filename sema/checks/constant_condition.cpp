// SPDX-License-Identifier: Apache-2.0
// Warns of an IF whose condition is a literal: one of its branches never runs. PLCopen coding rule CP2.
//   passes  IF ready THEN
//   fails   IF TRUE THEN
// Called for each condition of IF and ELSIF.
#include "sema/checks/constant_condition.h"

#include "sema/checks/diagnostics.h"

namespace rung::sema {

void checkConstantCondition(Context& context, ExprId condition) {
  const Tree& tree = context.tree();
  if (tree.kind(condition) != ExprKind::Literal || tree.expr(condition).type != types::kBool) return;
  const bool value = tree.as<LiteralExpr>(condition).value() != 0;
  context.report(diag::ConstantCondition, tree.loc(condition), {value ? "TRUE" : "FALSE"});
}

}  // namespace rung::sema
