// SPDX-License-Identifier: Apache-2.0
#include "sema/checks/operation.h"

namespace rung::sema {

std::optional<Operation> operationOf(const Context& context, ExprId expr) {
  const Tree& tree = context.tree();
  if (tree.kind(expr) == ExprKind::Binary) {
    const BinaryExpr& node = tree.as<BinaryExpr>(expr);
    return Operation{operatorOf(node.op()), node.left, node.right, node.h.loc, true};
  }
  if (tree.kind(expr) != ExprKind::Call) return std::nullopt;
  const CallExpr& node = tree.as<CallExpr>(expr);
  const Call& call = context.symbols.call(meaning(node.h).call);
  if (call.kind != CallKind::Operator || call.bindings.size() != 2) return std::nullopt;
  const Pou::Pragmas& pragmas = context.symbols.pou(call.pou).pragmas;
  const ExprId left = call.bindings[0].value, right = call.bindings[1].value;
  if (pragmas.operator_kind != OperatorKind::Op || !left || !right) return std::nullopt;
  return Operation{pragmas.op, left, right, node.h.loc, false};
}

}  // namespace rung::sema
