// SPDX-License-Identifier: Apache-2.0
// Short forms for all of sema: entities of ids, names as text.
#pragma once

#include <string>
#include <string_view>

#include "sema/context.h"

namespace rung::sema {

using types::TypeKind;

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

}  // namespace rung::sema
