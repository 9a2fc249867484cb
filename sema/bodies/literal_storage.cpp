// SPDX-License-Identifier: Apache-2.0
// Memory for strings whose address is taken: ADR('text') of codesys needs memory for the literal. Equal strings of one
// POU share it; CODESYS leaves open what happens when it is written through the pointer. In: literals of one POU. Out:
// constants in a separate global list, which no name in a program can reach. The list is declared when the body is
// checked, so that a POU's list depends on its own source alone.
#include "sema/bodies/literal_storage.h"

#include <algorithm>

#include "sema/declarations/collect.h"
#include "sema/declarations/configuration.h"
#include "sema/declarations/resolve.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

ExprId storageOfLiteral(Context& context, ExprId literal) {
  Symbols& symbols = context.symbols;
  const LiteralExpr& node = context.tree().as<LiteralExpr>(literal);
  const Loc loc = node.h.loc;
  const bool wide = node.literal() == LiteralKind::WString;
  const NameId characters = context.names().intern(context.tree().string(node.string()));
  Scopes::LiteralStorage& literal_storage = context.scopes.literal_storage;
  VarId& storage = literal_storage.variables[{context.pou.index, uint64_t{characters.index} << 1 | uint64_t{wide}}];
  if (!storage) {
    storage = VarId{static_cast<uint32_t>(symbols.vars.size())};
    Var var;
    var.name = context.names().intern("text" + std::to_string(literal_storage.variables.size()));
    var.loc = loc;
    // Room for access through a pointer to a STRING of the usual length.
    const uint32_t length = std::max(context.types().info(context.types().resolve(meaning(node.h).type)).length, 80u);
    var.type = wide ? context.types().wstring(length) : context.types().string(length);
    var.section = SectionKind::Global;
    var.storage = Storage::Global;
    var.constant = true;
    var.used = {1, 1};
    var.init = literal;
    symbols.vars.push_back(var);
    literal_storage.undeclared.push_back({context.pou, storage});
  }
  const Var& var = symbols.var(storage);
  return typed(context, makeName(context, var.name, entity(storage), loc), var.type);
}

void declareLiteralStorage(Context& context, PouId pou) {
  Symbols& symbols = context.symbols;
  std::vector<Scopes::LiteralStorage::Entry>& undeclared = context.scopes.literal_storage.undeclared;
  ListId list;
  size_t kept = 0;
  for (const Scopes::LiteralStorage::Entry entry : undeclared) {
    if (entry.pou != pou) {
      undeclared[kept++] = entry;
      continue;
    }
    if (!list) {
      const std::string owner = pou ? toString(context, symbols.pou(pou).unique_name) : std::string();
      const Loc loc = symbols.var(entry.var).loc;
      list = listNamed(context, owner + "__texts", symbols.sources.fileOf(loc), loc, context.scopes.qualifiers);
    }
    symbols.var(entry.var).list = list;
    symbols.global_lists[list.index].vars.push_back(entry.var);
  }
  undeclared.resize(kept);
  if (list) resolveDeclarations(context);
}

void declareLiteralStorage(Context& context) {
  while (!context.scopes.literal_storage.undeclared.empty())
    declareLiteralStorage(context, context.scopes.literal_storage.undeclared.front().pou);
}

}  // namespace rung::sema
