// SPDX-License-Identifier: Apache-2.0
// Short forms for all of sema: the context at another place, entities of ids, names as text.
#pragma once

#include <string>
#include <string_view>

#include "sema/context.h"
#include "sema/scopes.h"

namespace rung::sema {

// The same project seen from another location.
inline Context at(Context& context, PouId pou, FileId file, bool library, RegionId region = {}) {
  return Context{.symbols = context.symbols,
                 .project = context.project,
                 .scopes = context.scopes,
                 .pou = pou,
                 .file = file,
                 .library = library,
                 .region = region,
                 .rules = context.rules,
                 .expressions = context.expressions};
}

inline Context atPou(Context& context, PouId pou) {
  Context there = at(context, pou, context.symbols.pou(pou).file, context.symbols.pou(pou).library,
                     context.scopes.pous[pou.index].region);
  const PouId owner = context.symbols.pou(pou).owner;
  there.resource = context.scopes.pous[owner ? owner.index : pou.index].resource;
  return there;
}

inline Entity entity(VarId id) { return Entity::of(EntityKind::Var, id.index); }
inline Entity entity(PouId id) { return Entity::of(EntityKind::Pou, id.index); }
inline Entity entity(TypeId id) { return Entity::of(EntityKind::Type, id.index); }
inline NameId keyOf(const Context& context, NameId name) { return context.names().key(name); }
inline std::string toString(const Context& context, NameId name) { return std::string(context.names().string(name)); }
inline std::string_view string(const Context& context, NameId name) { return context.names().string(name); }

inline bool isNamed(const Context& context, NameId name, std::string_view word) {
  const std::string_view spelling = string(context, name);
  return spelling.size() == word.size() && sameIdentifier(spelling, word);
}

using types::TypeKind;

}  // namespace rung::sema
