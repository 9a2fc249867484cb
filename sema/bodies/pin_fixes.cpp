// SPDX-License-Identifier: Apache-2.0
#include "sema/bodies/pin_fixes.h"

#include "sema/bodies/calls.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/shorthands.h"

namespace rung::sema {
namespace {

// `text` is its value, or binds a pin.
Fix::Edit oneMoreArgument(const Context& context, const CallExpr& call, const std::string& argument) {
  if (call.is_bare) return {call.h.end, call.h.end, "(" + argument + ")"};
  if (!call.end || sourceText(context, {call.end, {call.end.offset + 1}}) != ")") return {};
  return {call.end, call.end, (call.arguments.empty() ? "" : ", ") + argument};
}

// The value of a type that means the least; empty: it has none.
std::string smallestValue(const Context& context, TypeId type) {
  const TypeKind kind = context.types().plainKind(type);
  if (context.types().kind(type) == TypeKind::Enum) return {};
  if (kind == TypeKind::Bool) return "FALSE";
  if (types::TypeTable::isInteger(kind) || types::TypeTable::isBits(kind)) return "0";
  if (kind == TypeKind::Real || kind == TypeKind::LReal) return "0.0";
  if (kind == TypeKind::String) return "''";
  if (kind == TypeKind::WString) return "\"\"";
  if (kind == TypeKind::Time) return "T#0s";
  return {};
}

}  // namespace

Fix withValues(Context& context, const CallExpr& call, PouId pou, VarId from) {
  std::string values, names;
  bool is_after = false;
  for (const VarId id : pinsOf(context, pou)) {
    const Var& pin = context.symbols.var(id);
    is_after = is_after || id == from;
    if (!is_after || pin.section != SectionKind::Input || pin.init) continue;
    const std::string value = smallestValue(context, pin.type);
    if (value.empty()) return {};
    values += (values.empty() ? "" : ", ") + value;
    names += (names.empty() ? "`" : ", `") + toString(context, pin.name) + "`";
  }
  if (values.empty()) return {};
  Fix::Edit edit = oneMoreArgument(context, call, values);
  return edit.begin ? Fix{"Add `" + values + "` for " + names, {std::move(edit)}, false} : Fix{};
}

Fix boundPin(Context& context, const CallExpr& call, const Var& pin) {
  if (!context.pou || !pin.type || pin.type == types::kError) return {};
  const std::string name = toString(context, pin.name);
  const std::string binding = name + " := " + name;
  const Fix::Edit edit = oneMoreArgument(context, call, binding);
  if (!edit.begin) return {};
  Fix fix{"Add `" + binding + "`", {edit}, false};
  const Entity known = lookUp(context, pin.name);
  if (known.entityKind() == EntityKind::Var) return fix;
  if (known) return {};
  Fix declared = declaredInPou(context, context.pou, SectionKind::Local, {name, context.types().toString(pin.type)});
  if (declared.edits.empty()) return {};
  fix.title += " and declare `" + name + "`";
  fix.edits.insert(fix.edits.end(), declared.edits.begin(), declared.edits.end());
  return fix;
}

}  // namespace rung::sema
