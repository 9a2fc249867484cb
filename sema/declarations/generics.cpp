// SPDX-License-Identifier: Apache-2.0
// Instances of generic library functions and of blocks with VAR_GENERIC CONSTANT: the source is parsed again for each
// tuple of types or values, so that the instance is checked and lowered like any other POU.
#include "sema/declarations/generics.h"

#include <algorithm>

#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/limits.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

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
  for (TypeId at = type; at; at = table.info(at).base)  // messages may name two types alike
    if (table.info(at).shown_name) return name.append("_").append(table.names().string(table.info(at).name));
  return name;
}

// ---- VAR_GENERIC CONSTANT

bool isGenericSection(const Tree& tree, DeclId section) { return tree.as<SectionDecl>(section).qualifiers.generic; }

std::vector<Ident> genericsOf(const Tree& tree, const PouDecl& block) {
  std::vector<Ident> names;
  for (const DeclId section : tree.list(block.sections)) {
    if (!isGenericSection(tree, section)) continue;
    for (const DeclId decl : tree.list(tree.as<SectionDecl>(section).vars))
      for (const Ident& name : tree.list(tree.as<VarDecl>(decl).names)) names.push_back(name);
  }
  return names;
}

struct GenericValue {
  std::optional<int64_t> value;
  Loc loc;
};

// The values in `Ring<20>`, in the order of the constants. Forbids values for constants that a block does not have, and
// a constant without a value. CODESYS, "Variable: VAR_GENERIC CONSTANT", C0586, C0587.
//   passes  a : Ring<20>;  b : Ring<(size := 2 * n)>;      fails  c : Ring;      E0375
bool readGenerics(Context& context, const Pou& block, const std::vector<Ident>& names, const NamedTypeExpr& written,
                  std::vector<GenericValue>& values) {
  const Tree& tree = context.tree();
  const std::string_view name = context.names().string(block.name);
  values.resize(names.size());
  size_t next = 0;
  for (const Argument& given : tree.list(written.generics)) {
    size_t at = next++;
    if (given.pin.name)
      for (at = 0; at < names.size() && !context.names().same(names[at].name, given.pin.name);) ++at;
    if (at >= names.size()) {
      const std::string count = std::to_string(names.size());
      if (given.pin.name)
        context.report(diag::UnknownGeneric, given.pin.loc, {name, context.names().string(given.pin.name)});
      else
        context.report(diag::SurplusGeneric, given.loc, {name, count});
      return false;
    }
    values[at] = {boundAsWritten(context, given.value), tree.begin(given.value)};
    if (!values[at].value) return false;
  }
  for (size_t i = 0; i < names.size(); ++i) {
    if (values[i].value) continue;
    context.report(diag::GenericWithoutValue, written.h.loc, {name, context.names().string(names[i].name)});
    return false;
  }
  return true;
}

ExprId literalOf(Context& context, const GenericValue& given) {
  TreeBuilder build(context.symbols.arena);
  const uint64_t bits = static_cast<uint64_t>(*given.value);
  if (*given.value >= 0) return build.literal(LiteralKind::Integer, bits, given.loc);
  return build.unary(UnaryOp::Negate, build.literal(LiteralKind::Integer, 0 - bits, given.loc), given.loc);
}

// Each generic constant gets a declaration of its own, with the value of the instance.
void setGenerics(Context& context, const PouDecl& block, const std::vector<GenericValue>& values) {
  Tree& tree = context.symbols.arena;
  size_t next = 0;
  for (const DeclId section : tree.list(block.sections)) {
    if (!isGenericSection(tree, section)) continue;
    std::vector<DeclId> vars;
    for (const DeclId decl : tree.list(tree.as<SectionDecl>(section).vars)) {
      const VarDecl shared = tree.as<VarDecl>(decl);
      for (const Ident& name : std::vector<Ident>(tree.list(shared.names).begin(), tree.list(shared.names).end())) {
        VarDecl own = shared;
        own.names = tree.addList<Ident>({&name, 1});
        own.init = literalOf(context, values[next++]);
        vars.push_back(tree.add<DeclId>(own));
      }
    }
    tree.as<SectionDecl>(section).vars = tree.addList<DeclId>(vars);
  }
}

// Where the source of a block ends: members may follow its END_FUNCTION_BLOCK.
Loc endOfBlock(const Tree& tree, const PouDecl& block) {
  Loc end = block.h.end;
  for (const DeclId member : tree.list(block.members))
    if (const Range range = tree.range(member); range.end.offset > end.offset) end = range.end;
  return end;
}

uint32_t libraryNamed(const Context& context, NameId name) {
  const auto& list = context.scopes.libraries.list;
  for (uint32_t i = 0; i < list.size(); ++i)
    if (name && list[i].name == name) return i;
  return kNoLibrary;
}

}  // namespace

PouId instantiateBlock(Context& context, PouId block_id, const NamedTypeExpr& written) {
  Symbols& symbols = context.symbols;
  Tree& tree = context.symbols.arena;
  const Pou& block = symbols.pou(block_id);
  if (!block.decl) return block_id;
  const std::vector<Ident> names = genericsOf(tree, tree.as<PouDecl>(block.decl));
  if (names.empty() && written.generics.empty()) return block_id;
  const PouId around = objectOf(context);
  const bool own = around && (around == block_id || symbols.pou(around).instance.of == block_id);
  if (own && written.generics.empty()) return around;
  std::vector<GenericValue> values;
  if (!readGenerics(context, block, names, written, values)) return {};
  std::string unique = toString(context, block.name) + "_", shown = toString(context, block.name);
  for (const GenericValue& given : values)
    shown += (&given == values.data() ? "<" : ", ") + std::to_string(*given.value);
  shown += '>';
  for (const GenericValue& given : values)
    unique += *given.value < 0 ? "_m" + std::to_string(0 - static_cast<uint64_t>(*given.value))
                               : "_" + std::to_string(*given.value);
  const NameId name = context.names().intern(unique);
  const NameId key = context.names().key(context.names().intern(toString(context, block.unique_name) + "<" + unique));
  if (const Entity known = context.scopes.instances.find(key)) return PouId{known.index};

  const uint32_t depth = around ? symbols.pou(around).instance.depth + 1 : 1;
  if (depth > kMaxGenericDepth) {
    context.report(diag::GenericsTooDeep, written.h.loc,
                   {context.names().string(block.name), std::to_string(kMaxGenericDepth)});
    return {};
  }
  const PouDecl& source = tree.as<PouDecl>(block.decl);
  const Slice<DeclId> decls = text::parseDeclarations(tree, symbols.names, symbols.sources, source.h.begin,
                                                      endOfBlock(tree, source), Dialect::Library, symbols.diagnostics);
  for (const DeclId decl : tree.list(decls)) {
    if (tree.kind(decl) != DeclKind::Pou) continue;
    tree.as<PouDecl>(decl).name = name;
    setGenerics(context, tree.as<PouDecl>(decl), values);
    const PouId id{static_cast<uint32_t>(symbols.pous.size())};
    context.scopes.instances.insert(key, entity(id));
    Context there = at(context, {}, block.file, block.library, context.scopes.pous[block_id.index].region);
    collectDecl(there, decl, block.file, block.library ? libraryNamed(context, block.library_name) : kNoLibrary);
    Pou& made = symbols.pou(id);
    made.name = context.names().intern(shown);
    if (made.record) context.types().edit(made.record).shown_name = made.name;
    made.instance.of = block_id;
    made.instance.depth = depth;
    return id;
  }
  return block_id;
}

namespace {

// What the generic types of the pins and of the result mean in one instance, each once.
std::vector<Substitution> substitutionsOf(const Context& context, const Pou& generic,
                                          std::span<const TypeId> types_by_pin, TypeId result) {
  std::vector<Substitution> all;
  const auto substitute = [&](TypeId declared, TypeId actual) {
    const types::TypeKind kind = context.types().kind(declared);
    const bool is_known =
        std::any_of(all.begin(), all.end(), [&](const Substitution& known) { return known.generic == kind; });
    if (types::TypeTable::isGeneric(kind) && actual && !is_known) all.push_back({kind, actual});
  };
  size_t pin = 0;
  for (const VarId id : generic.vars) {
    const Var& var = context.symbols.var(id);
    if (var.section != SectionKind::Input && var.section != SectionKind::InOut && var.section != SectionKind::Output)
      continue;
    if (pin < types_by_pin.size()) substitute(var.type, types_by_pin[pin]);
    ++pin;
  }
  if (generic.result) substitute(generic.result, result);
  return all;
}

// The generic function again, not yet resolved, with a declaration of its own.
Pou instanceOf(const Symbols& symbols, PouId generic, DeclId decl, NameId unique_name) {
  Pou pou = symbols.pou(generic);
  pou.decl = decl;
  pou.vars.clear();
  pou.pins.clear();
  pou.progress.pins_ready = false;
  pou.result = {};
  pou.result_var = {};
  pou.generic = pou.extensible = false;
  pou.progress.body = Pou::Progress::Body::New;
  pou.progress.used = true;
  pou.instance.of = generic;
  pou.unique_name = unique_name;
  return pou;
}

}  // namespace

PouId instantiate(Context& context, PouId generic_id, std::span<const TypeId> types_by_pin, TypeId result) {
  Symbols& symbols = context.symbols;
  Scopes& scopes = context.scopes;
  resolvePou(context, generic_id);
  const Pou& generic = symbols.pou(generic_id);
  if (!generic.generic) return generic_id;

  std::vector<Substitution> substitutions = substitutionsOf(context, generic, types_by_pin, result);
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
      text::parseDeclarations(symbols.arena, symbols.names, symbols.sources, written.h.begin, written.h.end,
                              generic.library ? Dialect::Library : symbols.profile.dialect, symbols.diagnostics);
  for (const DeclId decl : symbols.tree.list(decls)) {
    if (symbols.tree.kind(decl) != DeclKind::Pou) continue;
    const PouId id{static_cast<uint32_t>(symbols.pous.size())};
    symbols.pous.push_back(instanceOf(symbols, generic_id, decl, unique_name));
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
