// SPDX-License-Identifier: Apache-2.0
// Forbids a target that is not a variable: a literal, a result, an enumeration item; a constant; a VAR_INPUT inside its
// own POU (codesys: warning); the control variable of an enclosing FOR (codesys: warning); the state of a chart; a
// global marked {test_only}, outside of tests.
// IEC 61131-3 ed. 3, 6.5.2.2 and 7.3.3.4.2; docs/language.md "Dialects".
//   passes  level := 5;  motors[2].speed := 1.0;
//   fails   5 := level;  limit := 3 (VAR CONSTANT);  FOR i := 1 TO 3 DO i := 2; END_FOR
// Called for every target of an assignment, output binding and in-out argument.
#include "sema/bodies/writable.h"

#include "sema/bodies/body.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/names.h"
#include "sema/declarations/collect.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// What comes from outside, such as an input of the numerical control, is set by tests only.
//   fails   MB_START := TRUE;                                                     E1454
bool checkOutside(Context& context, const Var& var, Loc loc) {
  if (!var.list || !var.decl || context.library) return true;
  const DeclHeader& header = context.tree().as<VarDecl>(var.decl).h;
  if (findPragma(context, header, context.scopes.known_names.test_only) == nullptr) return true;
  if (context.pou) {
    const Pou& user = context.symbols.pou(context.pou);
    if (user.pragmas.test || user.pragmas.test_only || user.pragmas.replaces) return true;
  }
  context.report(diag::AssignToOutside, loc, {string(context, var.name)});
  return false;
}

bool checkVariable(Context& context, VarId id, Loc loc) {
  const Var& var = context.symbols.var(id);
  const std::string_view name = string(context, var.name);
  if (var.constant || (var.external && context.symbols.var(var.external).constant)) {
    context.report(diag::AssignToConstant, loc, {name}).declaredHere(var.loc);
    return false;
  }
  if (var.section == SectionKind::Input && var.pou == context.pou && !context.library) {
    if (context.types().isOpenArray(var.type)) {
      context.report(diag::OpenInputWritten, loc, {name}).declaredHere(var.loc);
      return false;
    }
    context.report(context.profile().writable_inputs ? diag::InputWritten : diag::AssignToInput, loc, {name});
    return context.profile().writable_inputs;
  }
  if (!checkOutside(context, var.external ? context.symbols.var(var.external) : var, loc)) return false;
  if (context.body == nullptr) return true;
  for (const BodyState::LoopControl& loop : context.body->loop_controls) {
    if (loop.var != id) continue;
    context.report(context.profile().writable_controls ? diag::ControlWritten : diag::AssignToControl, loc, {name})
        .note(loop.loc, diag::LoopIsHere);
    return context.profile().writable_controls;
  }
  return true;
}

// Forbids writing a chart's state of its steps and actions, except in the statements generated for the chart.
// IEC 61131-3 ed. 3, 6.7.2; TM/TP manual 5.5.2.5.
//   fails   INITIAL_STEP a: END_STEP …  ACTION b: a.x := TRUE; END_ACTION        E0746
bool checkOfChart(Context& context, VarId id, Loc loc, std::string_view member) {
  const Var& var = context.symbols.var(id);
  if (!var.of_chart || !var.type || context.types().kind(var.type) != types::TypeKind::Record) return true;
  const PouDecl& own = context.tree().as<PouDecl>(context.symbols.pou(context.pou).decl);
  if (own.body_kind == BodyKind::Sfc) return true;
  std::string what(string(context, var.name));
  if (!member.empty()) what += "." + std::string(member);
  context.report(diag::StepWritten, loc, {what});
  return false;
}

// A member: of a chart's state, of a list of globals, of an instance, or of a structure. `decided`: false where its
// base decides.
bool checkMemberWritable(Context& context, const MemberExpr& node, VarId var, bool& decided) {
  const Tree& tree = context.tree();
  const Entity of = entityOf(context, node.base);
  if (of.entityKind() == EntityKind::Var &&
      !checkOfChart(context, VarId{of.index}, node.h.loc, string(context, node.member)))
    return false;
  if (isWhole(context, node)) return checkVariable(context, var, node.h.loc);
  if (context.symbols.var(var).constant) {
    context.report(diag::AssignToConstant, node.h.loc, {string(context, node.member)})
        .declaredHere(context.symbols.var(var).loc);
    return false;
  }
  const types::TypeInfo& info = context.types().info(context.types().resolve(typeOf(tree, node.base)));
  decided = info.record_kind == types::RecordKind::FunctionBlock || info.record_kind == types::RecordKind::Program;
  return true;  // of an instance: checked by outside_access
}

}  // namespace

bool checkWritable(Context& context, ExprId expr, const Purpose& purpose) {
  const Tree& tree = context.tree();
  const ExprId whole = expr;
  const auto refuse = [&](Loc loc) {
    context.report(diag::NotAnLvalue, loc, {purpose.toString(context)});
    return false;
  };
  for (;; expr = tree.base(expr)) {
    const ExprKind kind = tree.kind(expr);
    switch (shape(kind)) {
      case ExprShape::Leaf: break;
      case ExprShape::Step:
        if (kind == ExprKind::Deref) return true;
        if (kind != ExprKind::Member) continue;
        break;
      case ExprShape::Operation:
      case ExprShape::Initializer:
      case ExprShape::Inserted: return refuse(tree.begin(whole));
    }
    if (kind == ExprKind::Literal || kind == ExprKind::TypedName) return refuse(tree.begin(whole));
    if (kind != ExprKind::Name && kind != ExprKind::Member) return true;
    const Entity entity = entityOf(context, expr);
    if (entity.entityKind() != EntityKind::Var) return refuse(tree.loc(expr));
    const VarId var{entity.index};
    if (kind == ExprKind::Name) {
      const bool passed = purpose.use != Use::Assigned;  // a whole step may be passed to an in-out
      return (passed || checkOfChart(context, var, tree.loc(expr), {})) && checkVariable(context, var, tree.loc(expr));
    }
    bool decided = true;
    const bool writable = checkMemberWritable(context, tree.as<MemberExpr>(expr), var, decided);
    if (decided) return writable;
  }
}

}  // namespace rung::sema
