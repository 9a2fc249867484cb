// SPDX-License-Identifier: Apache-2.0
// Warns of an instance of a library block whose in-out refers to a block, such as an axis or an encoder, and to another
// one in another call of the same body: the instance keeps the state of one. TM/TP manual 1.7.1.
//   passes  power(Axis := left);   power2(Axis := right);
//   warns   power(Axis := left);   power(Axis := right);             W0843
// Called for each call of an instance, in the order of the body. Only plain variables are compared.
#include "sema/bodies/body.h"
#include "sema/checks/rules.h"
#include "sema/shorthands.h"

namespace rung::sema {

void checkServedObject(Context& context, const CallExpr& node, const Call& call) {
  if (context.library || context.body == nullptr || !context.symbols.pou(call.pou).library) return;
  const auto variableOf = [&](ExprId expr) {
    const bool is_name = expr && context.tree().kind(expr) == ExprKind::Name;
    const Entity entity = is_name ? context.meaning(expr).entity : Entity();
    return entity.entityKind() == EntityKind::Var ? VarId{entity.index} : VarId{};
  };
  const VarId instance = variableOf(node.callee);
  if (!instance) return;
  for (const Binding& binding : call.bindings) {
    if (!binding.pin || binding.is_output) continue;
    const Var& pin = context.symbols.var(binding.pin);
    const VarId object = variableOf(binding.value);
    const types::TypeInfo& type = context.types().info(context.types().resolve(pin.type));
    const bool is_block = type.kind == TypeKind::Record && type.record_kind == types::RecordKind::FunctionBlock;
    if (pin.section != SectionKind::InOut || !is_block || !object) continue;
    bool is_first = true;
    for (const BodyState::Served& served : context.body->served) {
      if (served.instance != instance || served.pin != binding.pin) continue;
      is_first = false;
      if (served.object == object) continue;
      context.report(diag::ServesTwo, context.tree().begin(node.callee),
                     {string(context, context.symbols.var(instance).name),
                      string(context, context.symbols.var(served.object).name),
                      string(context, context.symbols.var(object).name)});
    }
    if (is_first) context.body->served.push_back({instance, binding.pin, object});
  }
}

}  // namespace rung::sema
