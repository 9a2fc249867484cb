// SPDX-License-Identifier: Apache-2.0
#include "ir/string_end.h"

#include "ir/walk.h"

namespace rung::ir {

bool mayLackEnd(const types::TypeTable& types, const Body& body, ExprId place) {
  for (ExprId at = place; at; at = baseOf(body.expr(at))) {
    const Expr& e = body.expr(at);
    if (e.kind == ExprKind::Image || e.kind == ExprKind::Deref) return true;
    if (e.kind != ExprKind::Field) continue;
    const types::TypeInfo& info = types.info(types.resolve(body.expr(baseOf(e)).type));
    if (info.record_kind == types::RecordKind::Union || info.overlaps) return true;
  }
  return false;
}

}  // namespace rung::ir
