// Forbids (codesys: warns of) keeping the address of a variable that lives for one call only in memory that lives
// longer. IEC 61131-3 ed. 3, 6.4.4.10.2: a reference to a temporary variable must not leave its POU.
//   passes  FUNCTION f … VAR p : REF_TO INT; x : INT; END_VAR p := REF(x);
//   fails   FUNCTION f … VAR x : INT; END_VAR keeper.p := REF(x);                                        E0538
// Called for each assignment of a pointer and each binding of a reference.
#include "sema/checks/dangling_address.h"

#include "sema/checks/diagnostics.h"

namespace rung::sema {

namespace {

// The variable that holds a place, or none where a pointer leads there.
VarId rootOf(const Context& context, ExprId place) {
  const Tree& tree = context.tree();
  for (;;) {
    switch (tree.kind(place)) {
      case ExprKind::Name:
      case ExprKind::Member: {
        const Entity entity = entityOf(context, place);
        if (entity.what() != EntityKind::Var) return {};
        if (tree.kind(place) == ExprKind::Name || isWhole(context, tree.as<MemberExpr>(place)))
          return VarId{entity.index};
        place = tree.as<MemberExpr>(place).base;
        break;
      }
      case ExprKind::Index: place = tree.as<IndexExpr>(place).base; break;
      case ExprKind::BitAccess: place = tree.as<BitAccessExpr>(place).base; break;
      case ExprKind::Convert: place = tree.as<ConvertExpr>(place).operand; break;
      case ExprKind::AddressOf: place = tree.as<AddressOfExpr>(place).place; break;
      case ExprKind::Deref:
      case ExprKind::Address:
      case ExprKind::Bound:
      case ExprKind::New:
      case ExprKind::AnyValue:
      case ExprKind::Error:
      case ExprKind::Literal:
      case ExprKind::TypedName:
      case ExprKind::Unary:
      case ExprKind::Binary:
      case ExprKind::Call:
      case ExprKind::Range:
      case ExprKind::ArrayInit:
      case ExprKind::This:
      case ExprKind::Super:
      case ExprKind::Repeat:
      case ExprKind::StructInit: return {};
    }
  }
}

// Memory of one call: what a caller owns is not.
bool livesForOneCall(const Context& context, VarId id) {
  if (!id) return false;
  const Var& var = context.symbols.var(id);
  if (var.storage != Storage::Local || var.section == SectionKind::InOut) return false;
  const types::TypeKind kind = context.types().kind(var.type);
  const bool by_reference = kind == TypeKind::Array || kind == TypeKind::Record || types::TypeTable::isText(kind);
  return var.section != SectionKind::Input || !by_reference;
}

}  // namespace

void checkDanglingAddress(Context& context, ExprId target, ExprId value) {
  const Tree& tree = context.tree();
  ExprId address = value;
  bool of_object = false;  // an object as an interface is its address
  while (tree.kind(address) == ExprKind::Convert) {
    address = tree.as<ConvertExpr>(address).operand;
    of_object = context.types().kind(tree.expr(address).type) == types::TypeKind::Record;
  }
  if (tree.kind(address) != ExprKind::AddressOf && !of_object) return;
  const VarId variable = rootOf(context, address);
  if (!livesForOneCall(context, variable)) return;
  const VarId keeper = rootOf(context, target);
  const bool leaves = keeper && (context.symbols.var(keeper).section == SectionKind::Output ||
                                 keeper == context.symbols.pou(context.pou).result_var);
  if (keeper && !leaves && livesForOneCall(context, keeper)) return;
  context.report(context.iec() ? diag::DanglingAddress : diag::AddressOutlives, tree.loc(address),
                 {text(context, context.symbols.var(variable).name)});
}

}  // namespace rung::sema
