// SPDX-License-Identifier: Apache-2.0
// Inputs of type ANY, ANY_NUM … of a POU in codesys: the caller passes the address, the length and the type class of
// its variable (__SYSTEM.AnyType). In: the argument. Out: an AnyValueExpr. Called for each call that binds one.
#include "sema/bodies/any_inputs.h"

#include "sema/access.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/generic_calls.h"
#include "sema/bodies/literals.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

uint32_t typeClassOf(const Context& context, TypeId type) {
  return types::rowOf(context.types().kind(type)).class_number;
}

void bindAny(Context& context, const Pou& pou, const Var& pin, ExprId& value) {
  TypeId type = check(context, value, {}, Access::Address);
  if (isUntyped(context, type)) type = finalizeUntyped(context, value);
  if (!type || type == types::kError || pin.type == types::kError) return;
  if (context.types().resolve(type) == context.types().resolve(pin.type)) return;  // an ANY input passed on
  const Loc loc = context.tree().begin(value);
  if (context.types().isOpenArray(type) || !belongs(context, type, context.types().kind(pin.any))) {
    context.report(diag::NotOfGeneric, loc,
                   {context.types().toString(type), string(context, pou.name), context.types().toString(pin.any)});
    return;
  }
  if (const PouId record = pouOf(context, type)) resolvePou(context, record);
  if (!ensureLayout(context, type)) return;
  const ExprId passed = context.build().anyValue(value, {}, typeClassOf(context, type), loc);
  context.replace(value, typed(context, passed, pin.type));
}

}  // namespace rung::sema
