// SPDX-License-Identifier: Apache-2.0
// The report of a failed assertion: see assertion.h.
#include "ir/assertion.h"

namespace rung::ir {

rung_type_kind assertedKind(const types::TypeTable& types, TypeId type) {
  const types::TypeKind kind = types.kind(type);
  if (types::TypeTable::isString(kind)) return hostKind(types, types::idOf(kind));
  return types.info(types.resolve(type)).kind == types::TypeKind::Enum ? RUNG_ENUM : hostKind(types, type);
}

AssertionReport assertionReport(const Module& module, const Body& body, const Stmt& stmt) {
  AssertionReport out;
  out.position = filePosition(module, body, stmt.loc);
  if (!body.origin.path && stmt.loc) {
    const SourceLocation location = module.sources.location(stmt.loc);
    out.source = module.sources.line(location.file, location.line);
  }
  const AssertStmt& assert_stmt = stmt.as<AssertStmt>();
  if (assert_stmt.text) out.message = module.names.string(assert_stmt.text);
  if (assert_stmt.shown) out.shown = module.names.string(assert_stmt.shown);
  if (!assert_stmt.second) return out;
  const types::TypeInfo& type = module.types.info(module.types.resolve(body.expr(assert_stmt.second).type));
  if (type.kind != types::TypeKind::Enum) return out;
  for (const auto& [name, value] : type.items) {
    out.items += module.names.string(name);
    out.items += '\0';
    out.items += std::to_string(value);
    out.items += '\0';
  }
  return out;
}

}  // namespace rung::ir
