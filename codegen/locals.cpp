// SPDX-License-Identifier: Apache-2.0
// The choice of cached fields: see locals.h.
#include "codegen/locals.h"

namespace rung::codegen {

namespace {

constexpr uint32_t kWorthIt = 3;  // uses that justify a load and a store

}  // namespace

CachedFields analyzeLocals(const ir::Module& module, const Facts& facts, const Uses& uses) {
  const Variables& variables = uses.variables;
  CachedFields fields;
  fields.is_cached.resize(variables.count());
  for (uint32_t i = variables.localCount(); i < variables.count(); ++i) {
    const types::Field& field = variables.field(i);
    const VariableUse& use = uses.of[i];
    if (field.by_reference || !types::TypeTable::isScalar(module.types.plainKind(field.type)) || use.exposed) continue;
    // Across a call a local is spilled, no better than memory: then only its uses in loops count.
    if ((uses.has_calls ? use.loop_weight : use.weight) <= kWorthIt) continue;
    fields.is_cached[i] = !facts.exposure.isExposed(variables.record(), variables.fieldIndex(i));
  }
  return fields;
}

std::string CachedFields::toString(const Variables& variables) const {
  std::vector<std::string> rows(is_cached.size());
  for (uint32_t i = 0; i < rows.size(); ++i) {
    if (is_cached[i] != 0) rows[i] = " cached";
  }
  return variables.lines(rows);
}

}  // namespace rung::codegen
