// SPDX-License-Identifier: Apache-2.0
// VAR_TEMP that actions share with the body that calls them (sema/declarations/shared_temporaries.cpp). In: the body of
// a block, of a program or of an action. Out: the statements around it. A body saves the fields, gives them their
// initial values and restores them when it returns, so that a call of the same instance inside of the call, as
// `SUPER^()`, has values of its own. An action that is called while no body runs begins with the initial values.
#include "ir/lower/lowering.h"

namespace rung::ir {

void StatementLowering::saveField(sema::VarId field, Loc loc) {
  TypeId type = strip(project_.var(field).type);
  const ExprId saved = temp(type, loc);
  assign(copy(saved), places().varPlace(field, loc), loc);
  state_.saved_fields.push_back({field, *localOf(body_.expr(saved))});
}

// The instances in a VAR_TEMP begin again in each call, so nothing is saved.
bool StatementLowering::holdsInstance(TypeId type) const {
  type = strip(type);
  while (types_.kind(type) == TypeKind::Array) type = strip(types_.info(type).base);
  return static_cast<bool>(in_.records.pouOf(type));
}

void StatementLowering::enterBody() {
  const sema::Pou& pou = project_.pou(pou_);
  const bool is_action = pou.kind == PouKind::Action && pou.owner;
  if (!is_action && pou.kind != PouKind::FunctionBlock && pou.kind != PouKind::Program) return;
  std::vector<sema::PouId> levels;
  for (sema::PouId at = in_.objectOf(pou_); at; at = project_.pou(at).base)
    if (project_.pou(at).object.in_body) levels.insert(levels.begin(), at);
  for (const sema::PouId level : levels) {
    const Loc loc = pou.loc;
    const sema::VarId in_body = project_.pou(level).object.in_body;
    const auto initialize = [&] {
      for (const sema::VarId id : project_.pou(level).vars) {
        const sema::Var& var = project_.var(id);
        if (!var.sharing.field) continue;
        const sema::Var& declared = var.sharing.copy_of ? project_.var(var.sharing.copy_of) : var;
        objects().storeInitial(places().varPlace(var.sharing.field, loc), strip(var.type), declared.init, false);
      }
      assign(places().varPlace(in_body, loc), constantBool(true, loc), loc);
    };
    if (is_action) {
      saveField(in_body, loc);
      const StmtId fresh = block(initialize);
      const ExprId outside = unary(Op::Not, types::kBool, places().varPlace(in_body, loc), loc);
      append(loc, IfStmt{.condition = outside, .then_block = fresh});
      continue;
    }
    for (const sema::VarId id : project_.pou(level).vars)
      if (const sema::VarId field = project_.var(id).sharing.field; field && !holdsInstance(project_.var(field).type))
        saveField(field, loc);
    saveField(in_body, loc);
    initialize();
  }
}

void StatementLowering::leaveBody(Loc loc) {
  for (const BodyState::SavedField& saved : state_.saved_fields)
    assign(places().varPlace(saved.field, loc), local(saved.local, loc), loc);
}

}  // namespace rung::ir
