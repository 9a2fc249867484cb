// SPDX-License-Identifier: Apache-2.0
// Proves from names alone that two variables do not overlap in memory. In: checked expressions. Out: yes, or "not
// sure". Called by calls.cpp before it lets a chain of string functions work in the variable that is assigned.
#include <algorithm>

#include "ir/lower/lowering.h"
#include "sema/declarations/constants.h"

namespace rung::ir {

bool PlaceLowering::isPlainPlace(rung::ExprId id) const { return static_cast<bool>(rootVar(id)); }

sema::VarId PlaceLowering::rootVar(rung::ExprId id) const {
  while (true) {
    if (tree_.kind(id) == rung::ExprKind::Name) {
      sema::Entity entity = sema::meaning(tree_, id).entity;
      return entity.entityKind() == sema::EntityKind::Var ? sema::VarId{entity.index} : sema::VarId{};
    }
    if (tree_.kind(id) != rung::ExprKind::Member) return {};
    const MemberExpr& node = tree_.as<MemberExpr>(id);
    if (sema::meaning(node.h).entity.entityKind() != sema::EntityKind::Var) return {};
    TypeId base = strip(sema::typeOf(tree_, node.base));
    if (!base || types_.kind(base) != TypeKind::Record) return sema::VarId{sema::meaning(node.h).entity.index};
    id = node.base;
  }
}

bool PlaceLowering::areApart(sema::VarId a, sema::VarId b) const {
  if (project_.var(a).external) a = project_.var(a).external;
  if (project_.var(b).external) b = project_.var(b).external;
  if (a == b) return false;
  const sema::Var &x = project_.var(a), &y = project_.var(b);
  // Memory of this call alone. A result's memory is a temporary of the caller.
  auto isOwn = [&](sema::VarId id, const sema::Var& var) {
    if (id == project_.pou(pou_).result_var) return true;
    return var.storage == sema::Storage::Local && !var.sharing.field &&
           !body_.locals[state_.local_of[var.field] - 1].by_reference;
  };
  if (isOwn(a, x) || isOwn(b, y)) return true;
  auto isReference = [&](const sema::Var& var) {
    return var.section == SectionKind::InOut || var.storage == sema::Storage::Local ||
           types_.kind(strip(var.type)) == TypeKind::Reference;
  };
  if (isReference(x) || isReference(y)) return false;
  if (x.storage == sema::Storage::Constant || y.storage == sema::Storage::Constant) return true;
  if (x.storage == sema::Storage::Image || y.storage == sema::Storage::Image) return x.storage != y.storage;
  if (x.storage == sema::Storage::Field && y.storage == sema::Storage::Field && x.pou == y.pou) return true;
  // An instance may hold this call's memory.
  auto holdsNoInstance = [&](const sema::Var& var) {
    TypeKind kind = types_.plainKind(strip(var.type));
    return TypeTable::isScalar(kind) || TypeTable::isString(kind);
  };
  return holdsNoInstance(x) && holdsNoInstance(y);
}

bool PlaceLowering::isApart(rung::ExprId id, sema::VarId variable) const {
  constexpr uint8_t kChecksOfConversions = kCheckSubrange | kCheckConvert;
  const rung::ExprKind kind = tree_.kind(id);
  switch (shape(kind)) {
    case ExprShape::Leaf:
      if (kind == rung::ExprKind::Literal || kind == rung::ExprKind::TypedName) return true;
      return kind == rung::ExprKind::Name && isApartFrom(id, variable);
    case ExprShape::Step: return kind == rung::ExprKind::Member && isApartFrom(id, variable);
    case ExprShape::Operation:
      if (kind == rung::ExprKind::Unary) return isApart(tree_.as<rung::UnaryExpr>(id).operand, variable);
      if (kind == rung::ExprKind::Binary) return operandsAreApart(tree_.as<rung::BinaryExpr>(id), variable);
      return kind == rung::ExprKind::Call && argumentsAreApart(id, variable);
    case ExprShape::Inserted:
      return kind == rung::ExprKind::Convert && (in_.options.checks & kChecksOfConversions) == 0 &&
             isApart(tree_.as<rung::ConvertExpr>(id).operand, variable);
    case ExprShape::Initializer: return false;
  }
  return false;
}

bool PlaceLowering::isApartFrom(rung::ExprId id, sema::VarId variable) const {
  if (sema::constantOf(project_, id)) return true;
  const sema::VarId root = rootVar(id);
  return root && areApart(root, variable);
}

bool PlaceLowering::operandsAreApart(const rung::BinaryExpr& node, sema::VarId variable) const {
  if (node.op() == BinaryOp::Power) return false;
  if (node.op() == BinaryOp::Divide || node.op() == BinaryOp::Modulo) {  // a fault would leave the variable changed
    const auto divisor = sema::constantOf(project_, node.right);
    if (!divisor || !TypeTable::isScalar(types_.plainKind(divisor->type)) || divisor->bits == 0) return false;
  }
  return isApart(node.left, variable) && isApart(node.right, variable);
}

bool PlaceLowering::argumentsAreApart(rung::ExprId id, sema::VarId variable) const {
  if (!calls().isPlainCall(id)) return false;
  const sema::Call& call = project_.call(sema::meaning(tree_, id).call);
  if (call.kind != sema::CallKind::Function) return false;
  const sema::Pou& pou = project_.pou(call.pou);
  if (!pou.pragmas.pure || !pou.pragmas.native) return false;
  return std::all_of(call.bindings.begin(), call.bindings.end(),
                     [&](const sema::Binding& binding) { return !binding.value || isApart(binding.value, variable); });
}

}  // namespace rung::ir
