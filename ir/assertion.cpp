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
  if (stmt.d != 0) out.message = module.names.string(NameId{stmt.d});
  if (stmt.e != 0) out.shown = module.names.string(NameId{stmt.e});
  if (stmt.b == 0) return out;
  const types::TypeInfo& type = module.types.info(module.types.resolve(body.expr(ExprId{stmt.b}).type));
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
