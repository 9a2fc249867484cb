// SPDX-License-Identifier: Apache-2.0
// Warns of a function whose body never assigns its result. Syntax manual 5.6.1.3: the result is the type's default.
//   passes  FUNCTION Twice : INT … Twice := 2 * x;
//   fails   FUNCTION Twice : INT … y := 2 * x;
// Called at the end of each body.
#include "sema/checks/rules.h"
#include "sema/declarations/objects.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

void checkResultAssigned(Context& context) {
  const Pou& pou = context.symbols.pou(context.pou);
  if (pou.library || !pou.result_var || context.symbols.var(pou.result_var).used.writes != 0) return;
  const Entity named = context.scopes.pous[context.pou.index].names.find(keyOf(context, pou.name));
  if (named.entityKind() != EntityKind::Var || VarId{named.index} != pou.result_var) return;  // hidden: reported
  if (pou.owner && isLifeMethod(context, pou.name)) return;  // their results are not used
  context.report(diag::ResultNotAssigned, pou.loc, {string(context, pou.name)});
}

}  // namespace rung::sema
