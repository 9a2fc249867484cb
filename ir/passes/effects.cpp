// SPDX-License-Identifier: Apache-2.0
// See effects.h.
#include "ir/passes/effects.h"

namespace rung::ir {

using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;

bool isObject(const types::TypeTable& types, TypeId type) {
  const TypeInfo& info = types.info(types.resolve(type));
  return info.kind == TypeKind::Record && info.record_kind != RecordKind::Struct &&
         info.record_kind != RecordKind::Union && info.record_kind != RecordKind::GlobalList;
}

bool bindsOwn(const Body& body, const Stmt& stmt) {
  const auto* bind = stmt.tryAs<BindStmt>();
  const auto* field = bind == nullptr ? nullptr : body.expr(bind->field).tryAs<FieldExpr>();
  return field != nullptr && body.expr(field->base).kind == ExprKind::Self;
}

bool callReachesSelf(const Module& module, const Exposure& exposure, const Body& body, const CallStmt& call) {
  const Body& callee = module.body(call.callee);
  if (!body.self || callee.pure) return false;
  ExprId object = call.self;
  while (object) {
    const auto* field = body.expr(object).tryAs<FieldExpr>();
    if (field == nullptr) break;
    const TypeInfo& record = module.types.info(module.types.resolve(body.expr(field->base).type));
    if (record.fields[field->field].role != types::FieldRole::Base) break;
    object = field->base;
  }
  if (object && body.expr(object).kind == ExprKind::Self) return true;
  return !callee.library && exposure.isSeen(module.types.resolve(body.self));
}

Effect effectOfWrite(const Module& module, const Body& body, const std::vector<bool>& private_locals, ExprId place) {
  const types::TypeTable& types = module.types;
  const Expr* e = &body.expr(place);
  uint32_t below_self = kNoBit;  // the field of self that the place lies in
  bool leads_out = false, in_object = isObject(types, e->type);
  for (ExprId base = baseOf(*e); base; base = baseOf(*e)) {
    leads_out = leads_out || isReference(module, body, *e);
    const Expr& around = body.expr(base);
    if (const auto* field = e->tryAs<FieldExpr>()) {
      below_self = field->field;
      in_object = in_object || (around.kind != ExprKind::Self && isObject(types, around.type));
    }
    e = &around;
  }
  if (!leads_out) {
    const uint32_t* local = localOf(*e);
    if (local != nullptr && private_locals[*local]) return {Effect::Local, *local};
    if (e->kind == ExprKind::Image || (local != nullptr && !body.locals[*local].by_reference)) return {Effect::None};
    if (e->kind == ExprKind::Self) {
      const bool is_field =
          below_self != kNoBit && types.info(types.resolve(body.self)).record_kind != RecordKind::Union;
      return is_field ? Effect{Effect::Field, below_self} : Effect{Effect::Fields};
    }
  }
  return {in_object ? Effect::Fields : Effect::Exposed};
}

}  // namespace rung::ir
