// SPDX-License-Identifier: Apache-2.0
// Warns of an IF whose condition is a literal: one of its branches never runs. PLCopen coding rule CP2.
//   passes  IF ready THEN
//   fails   IF TRUE THEN
// Called for each statement.
#include "sema/checks/rules.h"

namespace rung::sema {

void checkConstantCondition(Context& context, const IfStmt& node) {
  const Tree& tree = context.tree();
  for (const IfBranch& branch : tree.list(node.branches)) {
    const ExprId condition = branch.condition;
    if (tree.kind(condition) != ExprKind::Literal || typeOf(tree, condition) != types::kBool) continue;
    const bool value = tree.as<LiteralExpr>(condition).value() != 0;
    context.report(diag::ConstantCondition, tree.loc(condition), {value ? "TRUE" : "FALSE"});
  }
}

}  // namespace rung::sema
