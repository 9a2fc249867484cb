// Instances of generic library functions: the source of the function is parsed again for each tuple of types, so that
// its body is checked and lowered like any other.
#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "sema/declarations/declarations.h"

namespace rung::sema {

namespace {

// The type as part of a name: `STRING[20]` is STRING_20.
std::string identifierOf(const types::TypeTable& table, TypeId type) {
  std::string name;
  for (const char c : table.toString(type)) {
    const bool ok = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (ok) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

}  // namespace

PouId instantiate(Context& context, PouId generic_id, std::span<const TypeId> types_by_pin, TypeId result) {
  Symbols& symbols = context.symbols;
  Scopes& scopes = context.scopes;
  resolvePou(context, generic_id);
  const Pou& generic = symbols.pou(generic_id);
  if (!generic.generic) return generic_id;

  std::vector<Substitution> substitutions;
  const auto substitute = [&](TypeId declared, TypeId actual) {
    const types::TypeKind kind = context.types().kind(declared);
    if (!types::TypeTable::isGeneric(kind) || !actual) return;
    for (const Substitution& known : substitutions) {
      if (known.generic == kind) return;  // a generic name means one type
    }
    substitutions.push_back({kind, actual});
  };
  size_t pin = 0;
  for (const VarId id : generic.vars) {
    const Var& var = symbols.var(id);
    if (var.section != SectionKind::Input && var.section != SectionKind::InOut && var.section != SectionKind::Output) {
      continue;
    }
    if (pin < types_by_pin.size()) substitute(var.type, types_by_pin[pin]);
    ++pin;
  }
  if (generic.result) substitute(generic.result, result);

  std::string unique = toString(context, generic.unique_name) + "__";
  for (size_t i = 0; i < substitutions.size(); ++i) {
    if (i > 0) unique += '_';
    unique += identifierOf(context.types(), substitutions[i].type);
  }
  const NameId unique_name = context.names().intern(unique);
  const NameId key = keyOf(context, unique_name);
  if (const Entity known = scopes.instances.find(key)) return PouId{known.index};

  const PouDecl& written = context.tree().as<PouDecl>(generic.decl);
  const Slice<DeclId> decls =
      text::parseDeclarations(symbols.tree, symbols.names, symbols.sources, written.h.begin, written.h.end,
                              generic.library ? Dialect::Codesys : symbols.dialect, symbols.diagnostics);
  for (const DeclId decl : symbols.tree.list(decls)) {
    if (symbols.tree.kind(decl) != DeclKind::Pou) continue;
    Pou pou = generic;
    pou.decl = decl;
    pou.vars.clear();
    pou.pins.clear();
    pou.progress.pins_ready = false;
    pou.result = {};
    pou.result_var = {};
    pou.generic = pou.extensible = false;
    pou.progress.body = Pou::Progress::Body::New;
    pou.progress.used = true;
    pou.generic_of = generic_id;
    pou.unique_name = unique_name;
    const PouId id{static_cast<uint32_t>(symbols.pous.size())};
    symbols.pous.push_back(std::move(pou));
    scopes.pous.emplace_back();
    scopes.pous.back().substitutions = std::move(substitutions);
    scopes.instances.insert(key, entity(id));
    resolvePou(context, id);
    resolveDeclarations(context);
    return id;
  }
  return generic_id;
}

}  // namespace rung::sema
