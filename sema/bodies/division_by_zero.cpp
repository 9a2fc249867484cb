// SPDX-License-Identifier: Apache-2.0
// Forbids a division of integers, or MOD in codesys, by a constant zero. IEC 61131-3 ed. 3, 7.3.2 (an error that is
// known at compile time). A division of REAL is infinity, and MOD in iec is 0 by the standard's definition: a warning.
//   passes  share := total / 4;
//   warns   ratio := level / 0.0;                           W0582
//   fails   share := total / 0;   share := 7 MOD 0;         E0505
// Called for each infix division and for DIV and MOD.
#include "sema/bodies/division_by_zero.h"

#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/literals.h"
#include "sema/diagnostics.h"
#include "sema/shorthands.h"

namespace rung::sema {

bool checkDivisor(Context& context, ExprId divisor, BinaryOp op) {
  const ExprHeader& header = context.tree().expr(divisor);
  bool zero = false;
  if (isUntyped(context, meaning(header).type)) {
    __int128 value;
    if (meaning(header).type == types::idOf(TypeKind::IntegerLiteral)) {
      zero = untypedValue(context, divisor, value) && value == 0;
    } else if (context.tree().kind(divisor) == ExprKind::Literal) {
      zero = context.tree().as<LiteralExpr>(divisor).value() == 0;
    }
  } else if (types::TypeTable::isReal(context.types().plainKind(meaning(header).type))) {
    zero = context.tree().kind(divisor) == ExprKind::Literal && context.tree().as<LiteralExpr>(divisor).value() == 0;
  } else {
    zero = constantInteger(context, divisor) == 0;
  }
  if (!zero) return true;
  const bool is_real = meaning(header).type == types::idOf(types::TypeKind::RealLiteral) ||
                       types::TypeTable::isReal(context.types().plainKind(meaning(header).type));
  const bool is_defined = is_real || (op == BinaryOp::Modulo && context.profile().modulo_by_zero_is_zero);
  if (is_defined) {
    if (!context.library)
      context.report(diag::ZeroDivisor, context.tree().begin(divisor), {is_real ? "infinite or NaN" : "0"});
    return true;
  }
  context.report(diag::DivisionByZero, context.tree().begin(divisor), {spelling(op)});
  return false;
}

}  // namespace rung::sema
