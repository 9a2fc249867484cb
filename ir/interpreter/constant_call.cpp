// SPDX-License-Identifier: Apache-2.0
// Constant functions: see constant_call.h.
#include "ir/interpreter/constant_call.h"

#include "ir/interpreter/function.h"
#include "ir/lower.h"

namespace rung::ir::interpreter {

namespace {

constexpr int64_t kBudget = 1'000'000;  // iterations and calls

// Uses nothing but its own variables; their types are known by now.
bool isClosed(Module& module, const Body& body) {
  if (body.native) return body.pure;
  if (body.kind != BodyKind::Function || body.cpp != 0) return false;
  for (const Expr& e : body.exprs) {
    if (e.kind == ExprKind::Global || e.kind == ExprKind::Program || e.kind == ExprKind::Image ||
        e.kind == ExprKind::Self || e.kind == ExprKind::Deref || e.kind == ExprKind::Address) {
      return false;
    }
  }
  for (const Local& local : body.locals) {
    TypeId type = module.types.resolve(local.type);
    while (module.types.info(type).kind == types::TypeKind::Array)
      type = module.types.resolve(module.types.info(type).base);
    if (module.types.info(type).kind == types::TypeKind::Record) return false;
    if (!module.types.layout(module.types.resolve(local.type))) return false;
  }
  return true;
}

}  // namespace

std::optional<types::Value> callConstant(sema::Project& project, sema::PouId function,
                                         std::span<const types::Value> values, std::span<const Native> natives,
                                         FunctionRef<bool(sema::PouId)> ready) {
  // Lowering returns the function that it needs next.
  for (sema::PouId next = function; next;) {
    if (!ready(next)) return std::nullopt;
    Module module(project.types, project.names, project.sources);
    BodyId body;
    next = lowerFunction(project, function, {}, module, body);
    if (next) continue;
    for (size_t i = 1; i < module.bodies.size(); ++i) {
      if (!isClosed(module, module.bodies[i])) return std::nullopt;
    }
    const FunctionResult result = runFunction(module, body, values, natives, kBudget, project.names);
    if (!result.trouble.empty() || result.fault != types::Fault::None || !result.value.type) return std::nullopt;
    return result.value;
  }
  return std::nullopt;
}

}  // namespace rung::ir::interpreter
