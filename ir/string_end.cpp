#include "ir/string_end.h"

namespace rung::ir {

bool mayLackEnd(const types::TypeTable& types, const Body& body, ExprId place) {
  for (ExprId at = place;;) {
    const Expr& e = body.expr(at);
    if (e.kind == ExprKind::Image || e.kind == ExprKind::Deref) return true;
    if (const auto* index = e.tryAs<IndexExpr>()) {
      at = index->base;
    } else if (const auto* field = e.tryAs<FieldExpr>()) {
      at = field->base;
      const types::TypeInfo& info = types.info(types.resolve(body.expr(at).type));
      if (info.record_kind == types::RecordKind::Union || info.overlaps) return true;
    } else {
      return false;
    }
  }
}

}  // namespace rung::ir
