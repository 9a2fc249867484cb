// SPDX-License-Identifier: Apache-2.0
// The names of items as strings, {attribute 'to_string'}. In: an enumeration. Out: a function of the library __SYSTEM;
// its source is composed here, so that it is checked and lowered like any other. CODESYS, "Attribute: to_string".
// Called for TO_STRING and TO_WSTRING of an enumeration.
#include "sema/declarations/item_names.h"

#include <unordered_set>

#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/resolve.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// A number that belongs to none of the items stays a number; of two items with one number, the first.
std::string sourceOf(const Context& context, const std::string& function, const types::TypeInfo& enumeration) {
  std::string source = "FUNCTION " + function + " : STRING VAR_INPUT IN : LINT; END_VAR\nCASE IN OF\n";
  std::unordered_set<int64_t> seen;
  for (const auto& [name, number] : enumeration.items) {
    if (!seen.insert(number).second) continue;
    source += "  " + std::to_string(number) + ": " + function + " := '" + toString(context, name) + "';\n";
  }
  return source + "ELSE " + function + " := LINT_TO_STRING(IN);\nEND_CASE\nEND_FUNCTION\n";
}

}  // namespace

PouId itemNamesOf(Context& context, TypeId type) {
  Symbols& symbols = context.symbols;
  Scopes& scopes = context.scopes;
  const TypeId enumeration = context.types().resolve(type);
  const types::TypeInfo& info = context.types().info(enumeration);
  const NamedType* const named = info.kind == types::TypeKind::Enum ? scopes.named(enumeration) : nullptr;
  if (named == nullptr || !named->decl) return {};
  if (findPragma(context, context.tree().decl(named->decl), scopes.known_names.attributes.to_string) == nullptr)
    return {};
  const std::string function = "__ITEM_OF_" + toString(context, info.name);
  const NameId key = keyOf(context, context.names().intern(function));
  if (const Entity known = scopes.instances.find(key)) return PouId{known.index};
  const Entity system = scopes.libraries.namespaces.find(keyOf(context, context.names().intern("__SYSTEM")));
  if (!system) return {};
  const std::string source = sourceOf(context, function, info);
  const auto length = static_cast<uint32_t>(source.size());
  const FileId file = symbols.sources.add("__system/" + function + ".st", source);
  if (!file) return {};
  const Loc begin = symbols.sources.begin(file);
  const Slice<DeclId> decls =
      text::parseDeclarations(symbols.arena, symbols.names, symbols.sources, begin, Loc{begin.offset + length},
                              Dialect::Library, symbols.diagnostics);
  const PouId id{static_cast<uint32_t>(symbols.pous.size())};
  Context there = at(context, {}, file, true);
  for (const DeclId decl : symbols.tree.list(decls)) collectDecl(there, decl, file, system.index);
  scopes.instances.insert(key, entity(id));
  resolveDeclarations(context);
  return id;
}

}  // namespace rung::sema
