// Facts about the module: see facts.h. One pass over all expressions and statements.
#include "codegen/facts.h"

#include "ir/walk.h"

namespace rung::codegen {

using ir::Body;
using ir::Expr;
using ir::ExprId;
using ir::ExprKind;
using ir::Stmt;
using ir::StmtKind;
using types::TypeKind;

namespace {

constexpr uint8_t kUnknown = 2;
constexpr size_t kInlineStmts = 16, kInlineExprs = 80;

bool isSmall(const Body& body) {
  if (body.stmts.size() > kInlineStmts || body.exprs.size() > kInlineExprs || body.has_labels) return false;
  for (const Expr& expr : body.exprs) {
    if (expr.checks != 0 || expr.kind == ExprKind::Data) return false;
  }
  for (const Stmt& stmt : body.stmts) {
    if (stmt.kind == StmtKind::Call || stmt.kind == StmtKind::Try || stmt.kind == StmtKind::Fault) return false;
  }
  return true;
}

// True when an lvalue may be reached by other means than the own instance or a plain local.
bool isForeign(const Body& body, ExprId place) {
  const Expr& root = body.expr(ir::rootOf(body, place));
  switch (root.kind) {
    case ExprKind::Self: return false;
    case ExprKind::Local: return body.locals[root.as<ir::LocalExpr>().local].by_reference;
    case ExprKind::Global:
    case ExprKind::Program:
    case ExprKind::Deref: return true;
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::String:
    case ExprKind::Data:
    case ExprKind::Zero:
    case ExprKind::Image:
    case ExprKind::Field:
    case ExprKind::Index:
    case ExprKind::Bits:
    case ExprKind::Unary:
    case ExprKind::Binary:
    case ExprKind::Convert:
    case ExprKind::Select:
    case ExprKind::Call:
    case ExprKind::Address: return false;
  }
  return false;
}

}  // namespace

Facts::Facts(const ir::Module& module) : MemoryBlocks(module) {
  is_zeroing.resize(module.bodies.size(), kUnknown);
  for (uint32_t i = 1; i < module.bodies.size(); ++i) is_zeroing[i] = onlyClears(module, ir::BodyId{i});
  is_inlined.resize(module.bodies.size());
  is_seen.resize(module.types.count());
  is_pointed.resize(module.types.count());
  for (uint32_t i = 0; i < module.types.count(); ++i) {
    const types::TypeInfo& info = module.types.info(TypeId{i});
    if (info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference)
      is_pointed[module.types.resolve(info.base).index] = 1;
  }
  for (const ir::Class& one : module.classes) is_seen[module.types.resolve(one.record).index] = 1;
  for (uint32_t i = 1; i < module.bodies.size(); ++i) {
    const Body& body = module.bodies[i];
    is_inlined[i] = body.kind == ir::BodyKind::Function && body.library && body.pure && !body.native && isSmall(body);
    for (uint32_t e = 1; e < body.exprs.size(); ++e) {
      const Expr& expr = body.exprs[e];
      if (const auto* address = expr.tryAs<ir::AddressExpr>()) {
        expose(module, body, address->place);
      } else if (const auto* field = expr.tryAs<ir::FieldExpr>()) {
        const TypeId record = module.types.resolve(body.expr(field->base).type);
        if (module.types.info(record).record_kind >= types::RecordKind::FunctionBlock && is_seen[record.index] == 0 &&
            isForeign(body, field->base)) {
          is_seen[record.index] = 1;
        }
      }
    }
    for (const Stmt& stmt : body.stmts) {
      if (const auto* bind = stmt.tryAs<ir::BindStmt>()) {
        if (bind->place) expose(module, body, bind->place);
      } else if (const auto* call = stmt.tryAs<ir::CallStmt>()) {
        const Body& callee = module.body(call->callee);  // a method changes its object
        if (call->self && callee.kind == ir::BodyKind::Function && isForeign(body, call->self))
          is_seen[module.types.resolve(callee.self).index] |= 1;
        ir::forEachRoot(module, body, stmt, [&](ExprId root, ir::Use use) {
          if (use == ir::Use::Reference && root != call->self) expose(module, body, root);
        });
      } else if (const auto* assign = stmt.tryAs<ir::AssignStmt>()) {
        const TypeId type = body.expr(assign->value).type;
        const TypeKind kind = module.types.kind(type);
        if (kind == TypeKind::Record || kind == TypeKind::Array) {
          if (isForeign(body, assign->value) || isForeign(body, assign->place)) seeAll(module, type);
        }
      }
    }
  }
}

bool Facts::onlyClears(const ir::Module& module, ir::BodyId id) {
  if (is_zeroing[id.index] != kUnknown) return is_zeroing[id.index] != 0;
  const Body& body = module.body(id);
  is_zeroing[id.index] = 0;
  if (body.kind != ir::BodyKind::Init || body.native) return false;
  bool clears = false;
  for (ir::StmtId at = body.first; at; at = body.stmt(at).next) {
    const Stmt& stmt = body.stmt(at);
    const auto* assign = stmt.tryAs<ir::AssignStmt>();
    const auto* call = stmt.tryAs<ir::CallStmt>();
    if (assign != nullptr && body.expr(assign->place).kind == ExprKind::Self &&
        body.expr(assign->value).kind == ExprKind::Zero) {
      clears = true;
    } else if (call == nullptr || !onlyClears(module, call->callee)) {
      return false;
    }
  }
  is_zeroing[id.index] = clears;
  return clears;
}

void Facts::expose(const ir::Module& module, const Body& body, ExprId place) {
  const TypeKind kind = module.types.kind(body.expr(place).type);
  if (kind == TypeKind::Record || kind == TypeKind::Array) seeAll(module, body.expr(place).type);
  for (; place; place = ir::baseOf(body.expr(place))) {
    const auto* field = body.expr(place).tryAs<ir::FieldExpr>();
    if (field == nullptr) continue;
    const TypeId record = module.types.resolve(body.expr(field->base).type);
    exposed_fields_.insert(uint64_t{record.index} << 32 | field->field);
    return;
  }
}

// A pointer to the whole reaches every part.
void Facts::seeAll(const ir::Module& module, TypeId type) {
  type = module.types.resolve(type);
  const types::TypeInfo& info = module.types.info(type);
  if (info.kind == TypeKind::Array) return seeAll(module, info.base);
  if (info.kind != TypeKind::Record || is_seen[type.index] == 2) return;
  is_seen[type.index] = 2;
  for (uint32_t i = 0; i < info.fields.size(); ++i) {
    exposed_fields_.insert(uint64_t{type.index} << 32 | i);
    if (!info.fields[i].by_reference) seeAll(module, info.fields[i].type);
  }
}

}  // namespace rung::codegen
