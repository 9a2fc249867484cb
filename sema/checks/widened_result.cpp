// SPDX-License-Identifier: Apache-2.0
// Warns of a product or sum of integers, or a difference of unsigned ones, that is converted to a wider type only after
// it was calculated in the narrow one. In iec alone: codesys calculates in at least 32 bits (sema/intermediate.h). The
// same as SA0130 of CODESYS Static Analysis.
//   passes  d := INT_TO_DINT(i) * j;   i := i * j;
//   fails   d := i * j;                                  W0581
// Called for each implicit conversion that loses nothing.
#include "sema/checks/rules.h"
#include "sema/shorthands.h"

namespace rung::sema {

using types::TypeTable;

void checkWidenedResult(Context& context, ExprId value, TypeId to) {
  const Tree& tree = context.tree();
  if (!context.profile().warns_of_widened_results || tree.kind(value) != ExprKind::Binary ||
      meaning(tree, value).is_constant)
    return;
  const BinaryExpr& node = tree.as<BinaryExpr>(value);
  const TypeKind from = context.types().plainKind(meaning(node.h).type), target = context.types().plainKind(to);
  if (!TypeTable::isInteger(from) || TypeTable::bitWidth(target) <= TypeTable::bitWidth(from)) return;
  const bool borrows = node.op() == BinaryOp::Subtract && TypeTable::isUnsignedInteger(from);
  if (node.op() != BinaryOp::Add && node.op() != BinaryOp::Multiply && !borrows) return;
  context.report(diag::WidenedResult, node.h.loc,
                 {spelling(node.op()), context.types().toString(meaning(node.h).type), context.types().toString(to)});
}

}  // namespace rung::sema
