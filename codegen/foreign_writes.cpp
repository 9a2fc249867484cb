// SPDX-License-Identifier: Apache-2.0
// See foreign_writes.h.
#include "codegen/foreign_writes.h"

#include "ir/walk.h"

namespace rung::codegen {

using ir::ExprId;
using ir::ExprKind;
using ir::LocalKind;

bool ForeignWrites::by(const ir::Stmt& stmt) const {
  if (stmt.kind == ir::StmtKind::Bind) return true;
  if (const auto* call = stmt.tryAs<ir::CallStmt>(); call != nullptr && !module_.body(call->callee).pure) return true;
  bool found = false;
  ir::forEachRoot(module_, body_, stmt,
                  [&](ExprId root, ir::Use use) { found = found || (use != ir::Use::Read && isShared(root)); });
  return found;
}

// A scalar output is a temporary of the caller, who stores it after the call. The field next to the end of a path
// decides: with its address taken, all paths to it may be one variable.
bool ForeignWrites::isShared(ExprId place) const {
  bool has_field = false;
  for (ExprId at = place; at; at = ir::baseOf(body_.expr(at))) {
    const ir::Expr& e = body_.expr(at);
    if (const uint32_t* local = ir::localOf(e)) {
      const ir::Local& of = body_.locals[*local];
      const bool is_temporary =
          of.kind == LocalKind::Output && types::TypeTable::isScalar(module_.types.plainKind(of.type));
      return of.by_reference && !is_temporary && (of.kind == LocalKind::InOut || of.kind == LocalKind::Output);
    }
    const auto* field = e.tryAs<ir::FieldExpr>();
    if (field == nullptr) continue;
    const TypeId record = module_.types.resolve(body_.expr(field->base).type);
    const types::TypeInfo& info = module_.types.info(record);
    if (info.record_kind == types::RecordKind::Union || info.overlaps || info.fields[field->field].by_reference)
      return true;
    if (!has_field && exposure_.isExposed(record, field->field)) return true;
    has_field = true;
  }
  const types::TypeKind kind = module_.types.kind(body_.expr(place).type);
  if (kind == types::TypeKind::Record || kind == types::TypeKind::Array) return true;  // one of its parts may be shared
  const ExprKind root = body_.expr(ir::rootOf(body_, place)).kind;
  return !has_field || root == ExprKind::Deref || root == ExprKind::Image;
}

}  // namespace rung::codegen
