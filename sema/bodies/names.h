// SPDX-License-Identifier: Apache-2.0
// Names in expressions: variables, enumeration items, members of records, and qualified names (`GVL.x`, `Lib.f`);
// see names.cpp.
#pragma once

#include "sema/access.h"
#include "sema/context.h"

namespace rung::sema {

TypeId checkName(Context& context, ExprId& expr, TypeId expected, Access access);
TypeId checkTypedName(Context& context, ExprId& expr);
TypeId checkMember(Context& context, ExprId& expr, TypeId expected, Access access);
// True when a member expression names an entity as a whole (`GVL.x`, `Lib.f`, `Color.Red`), not a field of its base.
bool isWhole(const Context& context, const MemberExpr& node);
// The entity of a name in operand position; reports an unknown one and returns Error.
Entity resolveName(Context& context, const NameExpr& written, TypeId expected);
// The entity that an expression names, or none.
Entity entityOf(const Context& context, ExprId expr);
// The hidden variable with ENO of the last call of a named instance; none: nothing reads it.
VarId enoMemoryOf(const Context& context, ExprId instance);
// Notes the use of a variable at `loc`.
void markAccess(Context& context, VarId var, Access access, Loc loc);

inline NameId nameOf(const Context& context, ExprId expr) {
  if (context.tree().kind(expr) == ExprKind::Name) return context.tree().as<NameExpr>(expr).name;
  if (context.tree().kind(expr) == ExprKind::Member) return context.tree().as<MemberExpr>(expr).member;
  return {};
}

}  // namespace rung::sema
