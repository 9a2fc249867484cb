// SPDX-License-Identifier: Apache-2.0
// Warns of `=` and `<>` between REAL values: rounding makes equal results differ. PLCopen coding rule CP8.
// Comparison with a literal 0 is the usual guard of a division and passes.
//   passes  IF ABS(a - b) < 0.001 THEN   IF b <> 0.0 THEN
//   fails   IF a = b THEN
// Called for each operation whose sides are typed.
#include "sema/checks/rules.h"

namespace rung::sema {

void checkRealEquality(Context& context, const Operation& operation) {
  if (context.library || !operation.is_infix) return;
  if (operation.op != types::Op::Eq && operation.op != types::Op::Ne) return;
  const Tree& tree = context.tree();
  if (!types::TypeTable::isReal(context.types().plainKind(typeOf(tree, operation.left)))) return;
  for (const ExprId side : {operation.left, operation.right}) {
    if (tree.kind(side) == ExprKind::Literal && tree.as<LiteralExpr>(side).value() == 0) return;
  }
  context.report(diag::RealEquality, operation.loc, {operation.op == types::Op::Eq ? "=" : "<>"});
}

}  // namespace rung::sema
