// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/default_values.h"

#include "tools/ide/meanings.h"

namespace rung::ide {

DefaultValues::DefaultValues(const View& view, PouId from)
    : view_(view), scope_(view.meanings().scope()), project_(scope_.project()), from_(from) {}

void DefaultValues::collect() {
  if (std::exchange(is_collected_, true)) return;
  scope_.visible(from_, [&](NameId name, Entity entity) {
    if (entity.entityKind() != EntityKind::Var) return;
    const sema::Var& var = project_.vars[entity.index];
    const bool is_own = var.pou == from_ && var.section == SectionKind::Input;
    if (var.constant || is_own || !var.type) return;
    by_name_.emplace(view_.names().key(name).index, VarId{entity.index});
    by_type_.emplace(project_.types.resolve(var.type).index, VarId{entity.index});
  });
}

std::string DefaultValues::argumentFor(VarId pin) {
  collect();
  const sema::Var& var = project_.var(pin);
  const TypeId type = project_.types.resolve(var.type);
  const auto same = by_name_.find(view_.names().key(var.name).index);
  if (same != by_name_.end() && project_.types.resolve(project_.var(same->second).type) == type) return text(var.name);
  if (var.section == SectionKind::Input)
    if (std::string literal = literalOf(type); !literal.empty()) return literal;
  return variableOf(type);
}

std::string DefaultValues::variableOf(TypeId type) {
  collect();
  const auto found = by_type_.find(project_.types.resolve(type).index);
  return found == by_type_.end() ? std::string() : text(project_.var(found->second).name);
}

std::string DefaultValues::typedLiteralOf(TypeId type) const {
  const std::string literal = literalOf(type);
  const types::TypeKind kind = project_.types.plainKind(type);
  const bool is_number = types::TypeTable::isNumber(kind) || types::TypeTable::isBits(kind);
  if (literal.empty() || !is_number || literal == "FALSE" || types::TypeTable::isGeneric(kind)) return literal;
  return project_.types.toString(types::idOf(kind)) + "#" + literal;
}

std::string DefaultValues::literalOf(TypeId type) const {
  using types::TypeKind;
  const TypeId of = project_.types.resolve(type);
  const types::TypeInfo& info = project_.types.info(of);
  const TypeKind kind = project_.types.kind(of);
  if (kind == TypeKind::Enum)
    return info.items.empty() ? std::string() : project_.types.toString(of) + "#" + text(info.items.front().first);
  if (kind == TypeKind::Subrange) return info.low <= 0 && info.high >= 0 ? "0" : std::to_string(info.low);
  if (!types::TypeTable::isElementary(kind) && !types::TypeTable::isGeneric(kind)) return {};
  if (kind == TypeKind::Bool) return "FALSE";
  switch (types::categoryOf(kind)) {
    case types::TypeCategory::Bits:
    case types::TypeCategory::Signed:
    case types::TypeCategory::Unsigned: return "0";
    case types::TypeCategory::Real: return "0.0";
    case types::TypeCategory::Duration: return kind == TypeKind::LTime ? "LTIME#0s" : "T#0s";
    case types::TypeCategory::Date:
      if (types::TypeTable::isDay(kind)) return kind == TypeKind::Date ? "D#2000-01-01" : "LDATE#2000-01-01";
      if (types::TypeTable::isTimeOfDay(kind)) return kind == TypeKind::TimeOfDay ? "TOD#00:00:00" : "LTOD#00:00:00";
      return kind == TypeKind::DateTime ? "DT#2000-01-01-00:00:00" : "LDT#2000-01-01-00:00:00";
    case types::TypeCategory::String: return kind == TypeKind::WString ? "\"\"" : "''";
    case types::TypeCategory::Generic: return "0";
    case types::TypeCategory::Character:
    case types::TypeCategory::None:
    case types::TypeCategory::Bool:
    case types::TypeCategory::Literal:
    case types::TypeCategory::Derived:
    case types::TypeCategory::Pointer: break;
  }
  return {};
}

}  // namespace rung::ide
