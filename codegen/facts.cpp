// SPDX-License-Identifier: Apache-2.0
// Facts about the module: see facts.h.
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

// By body: tables of the module or of its classes name it, so that it needs a function of its own.
std::vector<uint8_t> namedInTables(const ir::Module& module) {
  std::vector<uint8_t> named(module.bodies.size());
  for (const ir::ProgramInstance& program : module.programs) named[program.body.index] = 1;
  for (const ir::Test& test : module.tests) named[test.body.index] = 1;
  for (const ir::Dispatch& dispatch : module.dispatches)
    for (const ir::BodyId body : dispatch.bodies) named[body.index] = 1;
  return named;
}

// A pure function, or the body of a function block.
bool isInlinedKind(const ir::Module& module, const Body& body) {
  if (body.kind == ir::BodyKind::Function) return body.pure;
  return body.kind == ir::BodyKind::Block &&
         module.types.info(module.types.resolve(body.self)).record_kind == types::RecordKind::FunctionBlock;
}

}  // namespace

Facts::Facts(const ir::Module& module, bool across_pous) : MemoryBlocks(module), exposure(module) {
  is_zeroing.resize(module.bodies.size(), kUnknown);
  for (uint32_t i = 1; i < module.bodies.size(); ++i) is_zeroing[i] = onlyClears(module, ir::BodyId{i});
  is_inlined.resize(module.bodies.size());
  is_pointed.resize(module.types.count());
  for (uint32_t i = 0; i < module.types.count(); ++i) {
    const types::TypeInfo& info = module.types.info(TypeId{i});
    if (info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference)
      is_pointed[module.types.resolve(info.base).index] = 1;
  }
  const std::vector<uint8_t> named = namedInTables(module);
  for (uint32_t i = 1; i < module.bodies.size(); ++i) {
    const Body& body = module.bodies[i];
    is_inlined[i] = (body.library || across_pous) && !body.native && body.cpp == 0 && !body.abstract && !body.test &&
                    named[i] == 0 && isInlinedKind(module, body) && isSmall(body);
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

}  // namespace rung::codegen
