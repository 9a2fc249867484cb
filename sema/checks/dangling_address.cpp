// SPDX-License-Identifier: Apache-2.0
// Forbids (codesys: warns of) storing the address of a variable that lives for one call in memory that lives longer.
// IEC 61131-3 ed. 3, 6.4.4.10.2: a reference to a temporary variable must not leave its POU.
//   passes  FUNCTION f … VAR p : REF_TO INT; x : INT; END_VAR p := REF(x);
//   fails   FUNCTION f … VAR x : INT; END_VAR keeper.p := REF(x);                                        E0538
// Called for each assignment of a pointer and each binding of a reference.
#include "sema/bodies/names.h"
#include "sema/checks/rules.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// The variable that holds an lvalue, or none where the path goes through a pointer.
VarId rootOf(const Context& context, ExprId lvalue) {
  const Tree& tree = context.tree();
  for (;;) {
    const ExprKind kind = tree.kind(lvalue);
    if (kind == ExprKind::Name || kind == ExprKind::Member) {
      const Entity entity = entityOf(context, lvalue);
      if (entity.entityKind() != EntityKind::Var) return {};
      if (kind == ExprKind::Name || isWhole(context, tree.as<MemberExpr>(lvalue))) return VarId{entity.index};
    }
    if (kind == ExprKind::Convert)
      lvalue = tree.as<ConvertExpr>(lvalue).operand;
    else if (kind == ExprKind::AddressOf)
      lvalue = tree.as<AddressOfExpr>(lvalue).lvalue;
    else if (shape(kind) == ExprShape::Step && kind != ExprKind::Deref)
      lvalue = tree.base(lvalue);
    else
      return {};
  }
}

// Memory of one call; memory of a caller is not.
bool isCallScoped(const Context& context, VarId id) {
  if (!id) return false;
  const Var& var = context.symbols.var(id);
  if (var.storage != Storage::Local || var.section == SectionKind::InOut) return false;
  const types::TypeKind kind = context.types().kind(var.type);
  const bool by_reference = kind == TypeKind::Array || kind == TypeKind::Record || types::TypeTable::isString(kind);
  return var.section != SectionKind::Input || !by_reference;
}

}  // namespace

void checkDanglingAddress(Context& context, ExprId target, ExprId value) {
  const Tree& tree = context.tree();
  ExprId address = value;
  bool of_object = false;  // an object as an interface is its address
  while (tree.kind(address) == ExprKind::Convert) {
    address = tree.as<ConvertExpr>(address).operand;
    of_object = context.types().kind(typeOf(tree, address)) == types::TypeKind::Record;
  }
  if (tree.kind(address) != ExprKind::AddressOf && !of_object) return;
  const VarId variable = rootOf(context, address);
  if (!isCallScoped(context, variable)) return;
  const VarId keeper = rootOf(context, target);
  const bool leaves = keeper && (context.symbols.var(keeper).section == SectionKind::Output ||
                                 keeper == context.symbols.pou(context.pou).result_var);
  if (keeper && !leaves && isCallScoped(context, keeper)) return;
  context.report(context.profile().lasting_addresses ? diag::AddressOutlives : diag::DanglingAddress, tree.loc(address),
                 {string(context, context.symbols.var(variable).name)});
}

}  // namespace rung::sema
