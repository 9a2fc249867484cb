// SPDX-License-Identifier: Apache-2.0
// Requires of FOR: the control variable is an integer variable, the step is not 0, and constant limits are reached.
// IEC 61131-3 ed. 3, 7.3.3.4.2.
//   passes  FOR i := 1 TO 9 BY 2 DO
//   fails   FOR r := 0.0 TO 1.0 DO (REAL)   FOR i := 1 TO 9 BY 0 DO   FOR i := 9 TO 1 DO (warning: never runs)
// Called for each FOR before its body.
#include "sema/checks/for_header.h"

#include "sema/checks/diagnostics.h"
#include "sema/checks/writable.h"

namespace rung::sema {

TypeId checkForControl(Context& context, ForStmt& node) {
  const TypeId type = check(context, node.control, {}, Access::ReadWrite);
  if (type == types::kError) return type;
  if (isUntyped(context, type)) finalizeUntyped(context, node.control);
  if (!checkWritable(context, node.control, Purpose{Use::LoopControl, {}, {}})) {
    return types::kError;
  }
  const TypeKind kind = context.types().plainKind(type);
  const bool enumeration = context.types().kind(type) == TypeKind::Enum;
  if (!enumeration &&
      (types::TypeTable::isInteger(kind) || (types::TypeTable::isBits(kind) && context.profile().bit_arithmetic))) {
    return type;
  }
  context.report(diag::ControlNotInteger, context.tree().loc(node.control), {context.types().toString(type)});
  return types::kError;
}

// After the last iteration the counter leaves its type: where it is not checked (TM/TP manual 5.2.4: "a limit value
// cannot be set"), the loop begins again. Rung's loops end.
//   warns   FOR i := 0 TO 127 DO         i : SINT              W0586
static void checkLastValue(Context& context, const ForStmt& node, int64_t from, int64_t to, int64_t step) {
  if (!context.profile().warns_of_endless_loops) return;
  const TypeId type = context.tree().expr(node.control).type;
  const TypeKind kind = context.types().plainKind(type);
  const bool is_signed = context.types().isSigned(kind);
  const auto wide = [&](int64_t n) { return is_signed ? __int128{n} : __int128{static_cast<uint64_t>(n)}; };
  const uint32_t width = types::TypeTable::bitWidth(kind);
  const __int128 low = is_signed ? -(__int128{1} << (width - 1)) : 0;
  const __int128 high = (__int128{1} << (is_signed ? width - 1 : width)) - 1;
  const __int128 way = wide(to) - wide(from);
  if (step == 0 || (way < 0) != (step < 0)) return;
  const __int128 next = wide(from) + (way / step + 1) * step;
  if (next <= high && next >= low) return;
  context.report(diag::LoopToTypeEnd, context.tree().begin(node.to), {context.types().toString(type)});
}

void checkForBounds(Context& context, const ForStmt& node) {
  const bool is_signed = context.types().isSigned(context.types().plainKind(context.tree().expr(node.control).type));
  const std::optional<int64_t> from = constantInteger(context, node.from), to = constantInteger(context, node.to);
  std::optional<int64_t> step = 1;
  if (node.step) {
    step = context.tree().expr(node.step).type == types::kError ? std::nullopt : constantInteger(context, node.step);
    if (step == 0) {
      context.report(diag::StepZero, context.tree().begin(node.step));
      return;
    }
  }
  if (!from || !to || !step || context.library) return;
  const bool step_is_signed =
      !node.step || context.types().isSigned(context.types().plainKind(context.tree().expr(node.step).type));
  const bool up = !step_is_signed || *step > 0;
  const auto less = [&](int64_t a, int64_t b) {
    return is_signed ? a < b : static_cast<uint64_t>(a) < static_cast<uint64_t>(b);
  };
  checkLastValue(context, node, *from, *to, *step);
  const bool never = up ? less(*to, *from) : less(*from, *to);
  if (never) {
    context.report(diag::LoopNeverRuns, context.tree().begin(node.from),
                   {std::to_string(*from), std::to_string(*to), up ? "BY -1" : "a positive step"});
  }
}

}  // namespace rung::sema
