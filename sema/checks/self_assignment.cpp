// SPDX-License-Identifier: Apache-2.0
// Warns of an assignment of a variable to itself: it does nothing, and most likely one side should be another variable.
// GCC and Clang have it as -Wself-assign.
//   passes  level := level + 1;   THIS^.level := level;   list[i] := list[j];
//   warns   level := level;   pump.speed := pump.speed;   target^.speed := target^.speed;         W0885
// Elements of arrays are not compared: an index may be a call with an effect. Nor are sides on two lines: such a line
// of ST is half-written (W0242), and IL has a line for each. Called for each statement.
#include "sema/bodies/names.h"
#include "sema/checks/rules.h"
#include "sema/fixes.h"
#include "sema/shorthands.h"

namespace rung::sema {
namespace {

VarId variableOf(const Context& context, ExprId expr) {
  const Entity entity = entityOf(context, expr);
  return entity.entityKind() == EntityKind::Var ? VarId{entity.index} : VarId{};
}

// Whether two checked lvalues are one variable on one path of names and `^`.
bool isSame(const Context& context, ExprId left, ExprId right) {
  const Tree& tree = context.tree();
  for (;; left = tree.base(left), right = tree.base(right)) {
    const ExprKind kind = tree.kind(left);
    if (kind != tree.kind(right)) return false;
    if (kind == ExprKind::This) return true;
    if (kind == ExprKind::Deref) continue;
    if (kind != ExprKind::Name && kind != ExprKind::Member) return false;
    const VarId variable = variableOf(context, left);
    if (!variable || variable != variableOf(context, right)) return false;
    if (kind == ExprKind::Name || isWhole(context, tree.as<MemberExpr>(left))) return true;
  }
}

}  // namespace

void checkSelfAssignment(Context& context, const AssignStmt& node) {
  if (context.library || node.op() != AssignOp::Assign || !isSame(context, node.target, node.value)) return;
  const auto lineOf = [&](ExprId expr) { return context.symbols.sources.lineNumber(context.tree().loc(expr)); };
  if (lineOf(node.value) != lineOf(node.target)) return;
  const VarId variable = variableOf(context, node.target);
  if (!variable || context.symbols.var(variable).temporary != 0) return;  // of a diagram
  context
      .report(diag::SelfAssignment, context.tree().begin(node.target),
              {string(context, context.symbols.var(variable).name)})
      .fix(withoutStatement(context, context.tree().begin(node.target), node.h.end));
}

}  // namespace rung::sema
