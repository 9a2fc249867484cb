// SPDX-License-Identifier: Apache-2.0
// Warns of SHL and SHR by a constant that is at least the width of the shifted value: nothing of it is left. CODESYS
// Static Analysis SA0053.
//   passes  low := SHR(mask, 8);         mask : WORD
//   warns   low := SHR(mask, 16);        mask : WORD           W0585
// Called for each call of these operators.
#include "sema/bodies/expressions.h"
#include "sema/bodies/literals.h"
#include "sema/checks/rules.h"
#include "sema/shorthands.h"

namespace rung::sema {

void checkShiftWidth(Context& context, const Operation& operation) {
  using types::Op;
  if (context.library || (operation.op != Op::Shl && operation.op != Op::Shr && operation.op != Op::Sar)) return;
  const ExprId value = operation.left, count = operation.right;
  const TypeId type = context.type(value);
  if (!type || type == types::kError || isUntyped(context, type)) return;
  const TypeKind kind = context.types().plainKind(type);
  if (!types::TypeTable::isInteger(kind) && !types::TypeTable::isBits(kind)) return;
  const std::optional<int64_t> by = constantInteger(context, count);
  const uint32_t width = types::TypeTable::bitWidth(kind);
  if (!by || *by < static_cast<int64_t>(width)) return;
  context.report(diag::ShiftedOut, context.tree().begin(count),
                 {std::to_string(*by), context.types().toString(type), std::to_string(width)});
}

}  // namespace rung::sema
