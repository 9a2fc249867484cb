// SPDX-License-Identifier: Apache-2.0
// The order of evaluation in lowering: which values move to a temporary, because a statement that follows could change
// what they read. In: expressions that are not part of a statement yet. Out: the same values, and the assignments of
// the temporaries. Called by all parts of lowering (body_part.h).
#include "ir/lower/lowering.h"

namespace rung::ir {

uint32_t BodyPart::effects() {
  for (; state_.effects_counted < body_.stmts.size(); ++state_.effects_counted)
    state_.effects += hasEffect(body_.stmts[state_.effects_counted]) ? 1 : 0;
  return state_.effects;
}

bool BodyPart::isStable(ExprId id) const {
  const Expr& expr = body_.expr(id);
  if (const uint32_t* local = localOf(expr)) return body_.locals[*local].kind == LocalKind::Temp;
  if (const auto* convert = expr.tryAs<ConvertExpr>()) return expr.checks == 0 && isStable(convert->operand);
  const ExprRole role = roleOf(expr.kind);
  return role == ExprRole::Constant || (role == ExprRole::Variable && expr.kind != ExprKind::Image);
}

// An index or pointer of a place goes to a temporary unless it is one.
void BodyPart::makeStable(ExprId& operand, Loc loc) {
  if (isStable(operand)) return;
  build_.detach(operand);  // from the place to an assignment
  operand = toTemp(operand, loc);
}

ExprId BodyPart::stable(ExprId place) {
  const Loc loc = body_.expr(place).loc;
  if (const ExprId base = baseOf(body_.expr(place))) stable(base);
  if (const auto* index = body_.expr(place).tryAs<IndexExpr>()) {
    const Slice<ExprId> indices = index->indices;
    for (uint32_t i = 0; i < indices.count; ++i) {
      ExprId operand = body_.list(indices)[i];
      makeStable(operand, loc);
      body_.list(indices)[i] = operand;
    }
  } else if (const auto* deref = body_.expr(place).tryAs<DerefExpr>()) {
    ExprId pointer = deref->pointer;
    makeStable(pointer, loc);
    body_.expr(place).as<DerefExpr>().pointer = pointer;
  } else {
    return place;
  }
  if (body_.expr(place).checks != 0) {  // checked once, here
    append(loc, EvaluateStmt{copy(place)});
    body_.expr(place).checks = 0;
  }
  return place;
}

bool BodyPart::isTemp(ExprId place) const {
  const uint32_t* root = localOf(body_.expr(rootOf(body_, place)));
  return root != nullptr && body_.locals[*root].kind == LocalKind::Temp;
}

bool BodyPart::hasEffect(const Stmt& stmt) const {
  if (effectOf(stmt.kind) != StmtEffect::Stores) return effectOf(stmt.kind) == StmtEffect::Acts;
  if (const auto* assign = stmt.tryAs<AssignStmt>()) return !isTemp(assign->place);
  if (const auto* loop = stmt.tryAs<ForStmt>()) return !isTemp(loop->control);
  const CallStmt& call = stmt.as<CallStmt>();
  return !in_.module.body(call.callee).pure || (call.result && !isTemp(call.result));
}

bool BodyPart::mustSpill(InsertionPoint point, ExprId value) {
  if (!value || build_.block().last == point.last || isStable(value)) return false;
  return effects() != point.effects || mayFault(value);
}

void BodyPart::spill(InsertionPoint point, std::initializer_list<ExprId*> values) {
  bool any = false;
  for (ExprId* value : values) any = any || mustSpill(point, *value);
  if (!any) return;
  std::vector<ExprId*> moved;
  for (ExprId* value : values)
    if (mustSpill(point, *value)) moved.push_back(value);
  insertAt(point, [&] {
    for (ExprId* value : moved) *value = toTemp(*value, body_.expr(*value).loc);
  });
}

void BodyPart::spillPlace(InsertionPoint point, ExprId& place) {
  if (!mustSpill(point, place)) return;
  insertAt(point, [&] { place = stable(place); });
}

ExprId BodyPart::toTemp(ExprId value, Loc loc) {
  const ExprId place = temp(typeOf(value), loc);
  assign(copy(place), value, loc);
  return place;
}

ExprId BodyPart::convertValue(ExprId value, TypeId to, Loc loc, types::Rounding rounding) {
  to = strip(to);
  TypeId from = typeOf(value);
  if (from == to) return value;
  if (body_.expr(value).kind == ExprKind::Const && TypeTable::isScalar(types_.plainKind(to)) &&
      TypeTable::isScalar(types_.plainKind(from)))
    return ofValue(types::convert(types_, {from, bitsOf(body_.expr(value))}, to, rounding).value, loc);
  return convert(value, to, loc, rounding);
}

}  // namespace rung::ir
