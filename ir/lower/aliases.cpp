// SPDX-License-Identifier: Apache-2.0
// Proves from names alone that two variables do not overlap in memory. In: checked expressions. Out: yes, or "not
// sure". Called by calls.cpp before it lets a chain of string functions work in the variable that is assigned.
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
  switch (tree_.kind(id)) {
    case rung::ExprKind::Literal:
    case rung::ExprKind::TypedName: return true;
    case rung::ExprKind::Name:
    case rung::ExprKind::Member: {
      if (sema::constantOf(project_, id)) return true;
      sema::VarId root = rootVar(id);
      return root && areApart(root, variable);
    }
    case rung::ExprKind::Convert:
      return (in_.options.checks & kChecksOfConversions) == 0 &&
             isApart(tree_.as<rung::ConvertExpr>(id).operand, variable);
    case rung::ExprKind::Unary: return isApart(tree_.as<rung::UnaryExpr>(id).operand, variable);
    case rung::ExprKind::Binary: {
      const rung::BinaryExpr& node = tree_.as<rung::BinaryExpr>(id);
      if (node.op() == BinaryOp::Power) return false;
      if (node.op() == BinaryOp::Divide || node.op() == BinaryOp::Modulo) {  // a fault would leave the variable changed
        auto divisor = sema::constantOf(project_, node.right);
        if (!divisor || !TypeTable::isScalar(types_.plainKind(divisor->type)) || divisor->bits == 0) return false;
      }
      return isApart(node.left, variable) && isApart(node.right, variable);
    }
    case rung::ExprKind::Call: {
      if (!calls().isPlainCall(id)) return false;
      const sema::Call& call = project_.call(sema::meaning(tree_, id).call);
      if (call.kind != sema::CallKind::Function) return false;
      const sema::Pou& pou = project_.pou(call.pou);
      if (!pou.pragmas.pure || !pou.pragmas.native) return false;
      for (const sema::Binding& binding : call.bindings)
        if (binding.value && !isApart(binding.value, variable)) return false;
      return true;
    }
    case rung::ExprKind::Error:
    case rung::ExprKind::Index:
    case rung::ExprKind::This:
    case rung::ExprKind::Super:
    case rung::ExprKind::Deref:
    case rung::ExprKind::BitAccess:
    case rung::ExprKind::Address:
    case rung::ExprKind::AddressOf:
    case rung::ExprKind::Bound:
    case rung::ExprKind::New:
    case rung::ExprKind::Assign:
    case rung::ExprKind::AnyValue:
    case rung::ExprKind::Range:
    case rung::ExprKind::ArrayInit:
    case rung::ExprKind::Repeat:
    case rung::ExprKind::StructInit: return false;
  }
  return false;
}

}  // namespace rung::ir
