// SPDX-License-Identifier: Apache-2.0
// Functions and methods of one name, distinguished by the types of their parameters. Edition 3 only: ed. 2 and codesys
// keep such names for the library. In: declarations. Out: lists of overloads, Pou::overloads and next_overload.
// bodies/overloads.cpp chooses the one that a call means.
#include <algorithm>

#include "frontend/source/dialect.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/overloads.h"
#include "sema/declarations/variables.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

bool addOverload(Context& context, Entity first, PouId added) {
  Symbols& symbols = context.symbols;
  if (!symbols.profile.overloads || first.entityKind() != EntityKind::Pou) return false;
  const PouId head{first.index};
  Pou& pou = symbols.pou(added);
  const PouKind kind = symbols.pou(head).kind;
  if (kind != pou.kind || (kind != PouKind::Function && kind != PouKind::Method) || symbols.pou(head).library)
    return false;
  PouId last = head;
  uint32_t count = 2;
  for (; symbols.pou(last).overloads.next; last = symbols.pou(last).overloads.next) ++count;
  symbols.pou(last).overloads.next = added;
  symbols.pou(head).overloads.first = pou.overloads.first = head;
  if (kind == PouKind::Function) {  // a method's name is unique already
    const std::string stem = toString(context, pou.unique_name) + "__";
    do {
      pou.unique_name = context.names().intern(stem + std::to_string(count++));
    } while (!context.scopes.member_names.insert(keyOf(context, pou.unique_name), entity(added)) ||
             context.scopes.pous_and_types.find(keyOf(context, pou.unique_name)));
  }
  return true;
}

void markOverloads(Context& context) {
  Symbols& symbols = context.symbols;
  if (!symbols.profile.overloads) return;
  const auto isOverloadedIn = [&](PouId object, const Pou& like) {
    for (const PouId member : symbols.pou(object).members)
      if (symbols.pou(member).overloads.first && symbols.names.same(symbols.pou(member).name, like.name)) return true;
    return false;
  };
  for (uint32_t i = 1; i < symbols.pous.size(); ++i) {
    Pou& pou = symbols.pous[i];
    if (pou.kind != PouKind::Method || pou.overloads.first || pou.object.accessor != AccessorKind::None) continue;
    for (PouId at = symbols.pou(pou.owner).base; at && !pou.overloads.first; at = symbols.pou(at).base)
      if (isOverloadedIn(at, pou)) pou.overloads.first = PouId{i};
  }
}

// Forbids overloads that no call could distinguish. IEC 61131-3 ed. 3, 6.1.2.
//   passes  FUNCTION f VAR_INPUT x : INT; …     FUNCTION f VAR_INPUT x : REAL; …
//   fails   FUNCTION f VAR_INPUT x : INT; …     FUNCTION f VAR_INPUT y : INT; …           E0301
void checkOverloads(Context& context, PouId head) {
  for (PouId id = head; id; id = context.symbols.pou(id).overloads.next) {
    resolvePou(context, id);
    for (PouId earlier = head; earlier != id; earlier = context.symbols.pou(earlier).overloads.next) {
      if (!sameParameters(context.symbols, earlier, id)) continue;
      reportTwice(context, context.symbols.pou(id).name, context.symbols.pou(id).loc, context.symbols.pou(earlier).loc);
      break;
    }
  }
}

}  // namespace rung::sema
