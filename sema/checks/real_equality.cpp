// SPDX-License-Identifier: Apache-2.0
// Warns of `=` and `<>` between REAL values: rounding makes equal results differ. PLCopen coding rule CP8.
// Comparison with a literal 0 is the usual guard of a division and passes.
//   passes  IF ABS(a - b) < 0.001 THEN   IF b <> 0.0 THEN
//   fails   IF a = b THEN
// Called for each operation whose sides are typed.
#include "sema/checks/rules.h"

namespace rung::sema {

void checkRealEquality(Context& context, ExprId expr) {
  const Tree& tree = context.tree();
  if (context.library || tree.kind(expr) != ExprKind::Binary) return;
  const BinaryExpr& node = tree.as<BinaryExpr>(expr);
  if (node.op() != BinaryOp::Equal && node.op() != BinaryOp::NotEqual) return;
  if (!types::TypeTable::isReal(context.types().plainKind(tree.expr(node.left).type))) return;
  for (const ExprId side : {node.left, node.right}) {
    if (tree.kind(side) == ExprKind::Literal && tree.as<LiteralExpr>(side).value() == 0) return;
  }
  context.report(diag::RealEquality, node.h.loc, {spelling(node.op())});
}

}  // namespace rung::sema
