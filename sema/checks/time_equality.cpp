// SPDX-License-Identifier: Apache-2.0
// Warns of `=` and `<>` between a TIME output of a block, such as the ET of a timer, and a constant other than 0:
// between two cycles the time passes over the value. CODESYS Static Analysis SA0054 has the same for REAL. Comparisons
// of two variables, mostly settings, are not reported, and neither are tests, which advance the time themselves.
//   passes  IF delay.ET >= T#2s THEN    IF delay.ET = T#0s THEN    IF setting <> old_setting THEN
//   fails   IF delay.ET = T#2s THEN
// Called for each operation whose sides are typed.
#include "sema/checks/rules.h"

namespace rung::sema {

namespace {

bool isOutputOfBlock(const Context& context, ExprId expr) {
  const Tree& tree = context.tree();
  if (tree.kind(expr) == ExprKind::Convert) expr = tree.as<ConvertExpr>(expr).operand;
  if (tree.kind(expr) != ExprKind::Member) return false;
  const Entity field = meaning(tree, expr).entity;
  if (field.entityKind() != EntityKind::Var) return false;
  const Var& var = context.symbols.var({field.index});
  return var.section == SectionKind::Output && var.pou && context.symbols.pou(var.pou).kind == PouKind::FunctionBlock;
}

bool isConstantTime(const Context& context, ExprId expr) {
  const Tree& tree = context.tree();
  if (tree.kind(expr) == ExprKind::Convert) expr = tree.as<ConvertExpr>(expr).operand;
  return tree.kind(expr) == ExprKind::Literal && tree.as<LiteralExpr>(expr).value() != 0;
}

}  // namespace

void checkTimeEquality(Context& context, const Operation& operation) {
  if (!operation.is_infix || (operation.op != types::Op::Eq && operation.op != types::Op::Ne)) return;
  if (context.library || (context.pou && context.symbols.pou(context.pou).pragmas.test)) return;
  const types::TypeKind kind = context.types().plainKind(context.type(operation.left));
  if (kind != types::TypeKind::Time && kind != types::TypeKind::LTime) return;
  if ((isOutputOfBlock(context, operation.left) && isConstantTime(context, operation.right)) ||
      (isOutputOfBlock(context, operation.right) && isConstantTime(context, operation.left)))
    context.report(diag::TimeEquality, operation.loc, {operation.op == types::Op::Eq ? "=" : "<>"})
        .replace(operation.op == types::Op::Eq ? ">=" : "<", Sureness::Proposal);
}

}  // namespace rung::sema
