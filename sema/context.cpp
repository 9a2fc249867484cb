// SPDX-License-Identifier: Apache-2.0
#include "sema/context.h"

#include "sema/scopes.h"

namespace rung::sema {

Context at(Context& context, PouId pou, FileId file, bool library, RegionId region) {
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

Context atPou(Context& context, PouId pou) {
  Context there = at(context, pou, context.symbols.pou(pou).file, context.symbols.pou(pou).library,
                     context.scopes.pous[pou.index].region);
  const PouId owner = context.symbols.pou(pou).owner;
  there.resource = context.scopes.pous[owner ? owner.index : pou.index].resource;
  return there;
}

ExprId& codeOf(Context& context, ExprId written) {
  const auto [slot, is_new] = context.scopes.code.try_emplace(written.word);
  if (!written) return slot->second = {};
  if (is_new) slot->second = context.code().copy(written);
  return slot->second;
}

}  // namespace rung::sema
