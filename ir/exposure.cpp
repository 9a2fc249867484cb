// SPDX-License-Identifier: Apache-2.0
// See exposure.h. One walk over all expressions and statements.
#include "ir/exposure.h"

#include "ir/walk.h"

namespace rung::ir {

using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;

namespace {

// True when an lvalue may be reached by other means than the own instance or a plain local.
bool isForeign(const Body& body, ExprId place) {
  const Expr& root = body.expr(rootOf(body, place));
  if (const uint32_t* local = localOf(root)) return body.locals[*local].by_reference;
  return root.kind == ExprKind::Global || root.kind == ExprKind::Program || root.kind == ExprKind::Deref;
}

}  // namespace

Exposure::Exposure(const Module& module) {
  seen_.resize(module.types.count());
  for (const Class& one : module.classes) see(module.types.resolve(one.record));
  for (uint32_t i = 1; i < module.bodies.size(); ++i) scan(module, module.bodies[i]);
}

void Exposure::scan(const Module& module, const Body& body) {
  for (const Expr& expr : body.exprs) {
    if (const auto* address = expr.tryAs<AddressExpr>()) {
      expose(module, body, address->place);
    } else if (const auto* field = expr.tryAs<FieldExpr>()) {
      const TypeId record = module.types.resolve(body.expr(field->base).type);
      const bool is_object = module.types.info(record).record_kind >= RecordKind::FunctionBlock;
      if (is_object && seen_[record.index] == Seen::No && isForeign(body, field->base)) see(record);
    }
  }
  for (const Stmt& stmt : body.stmts) {
    if (const auto* bind = stmt.tryAs<BindStmt>()) {
      if (bind->place) expose(module, body, bind->place);
    } else if (const auto* call = stmt.tryAs<CallStmt>()) {
      const Body& callee = module.body(call->callee);  // a method changes its object
      if (call->self && callee.kind == BodyKind::Function && isForeign(body, call->self))
        see(module.types.resolve(callee.self));
      forEachRoot(module, body, stmt, [&](ExprId root, Use use) {
        if (use == Use::Reference && root != call->self) expose(module, body, root);
      });
    } else if (const auto* assign = stmt.tryAs<AssignStmt>()) {
      const TypeId type = body.expr(assign->value).type;
      const TypeKind kind = module.types.kind(type);
      if ((kind == TypeKind::Record || kind == TypeKind::Array) &&
          (isForeign(body, assign->value) || isForeign(body, assign->place)))
        exposeAll(module, type);
    }
  }
}

void Exposure::expose(const Module& module, const Body& body, ExprId place) {
  const TypeKind kind = module.types.kind(body.expr(place).type);
  if (kind == TypeKind::Record || kind == TypeKind::Array) exposeAll(module, body.expr(place).type);
  for (; place; place = baseOf(body.expr(place))) {
    const auto* field = body.expr(place).tryAs<FieldExpr>();
    if (field == nullptr) continue;
    const TypeId record = module.types.resolve(body.expr(field->base).type);
    exposed_fields_.insert(uint64_t{record.index} << 32 | field->field);
    return;
  }
}

// A pointer to the whole reaches every part.
void Exposure::exposeAll(const Module& module, TypeId type) {
  type = module.types.resolve(type);
  const TypeInfo& info = module.types.info(type);
  if (info.kind == TypeKind::Array) return exposeAll(module, info.base);
  if (info.kind != TypeKind::Record || seen_[type.index] == Seen::Whole) return;
  seen_[type.index] = Seen::Whole;
  for (uint32_t i = 0; i < info.fields.size(); ++i) {
    exposed_fields_.insert(uint64_t{type.index} << 32 | i);
    if (!info.fields[i].by_reference) exposeAll(module, info.fields[i].type);
  }
}

}  // namespace rung::ir
