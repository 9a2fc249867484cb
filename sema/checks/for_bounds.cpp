// SPDX-License-Identifier: Apache-2.0
// Forbids a FOR with a step of 0, and warns of constant limits between which the loop never runs, or after which the
// counter leaves its type. IEC 61131-3 ed. 3, 7.3.3.4.2.
//   passes  FOR i := 1 TO 9 BY 2 DO
//   fails   FOR i := 1 TO 9 BY 0 DO                                   E0711
//   warns   FOR i := 9 TO 1 DO                                        W0755
#include "sema/bodies/expressions.h"
#include "sema/checks/rules.h"
#include "sema/fixes.h"
#include "sema/shorthands.h"

namespace rung::sema {

// After the last iteration the counter leaves its type: where it is not checked (TM/TP manual 5.2.4: "a limit value
// cannot be set"), the loop begins again. Rung's loops end.
//   warns   FOR i := 0 TO 127 DO         i : SINT              W0586
static void checkLastValue(Context& context, const ForStmt& node, int64_t from, int64_t to, int64_t step) {
  if (!context.profile().warns_of_endless_loops) return;
  const TypeId type = context.type(node.control);
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

static Fix withStepBack(const Context& context, const ForStmt& node) {
  const Loc end = sourceRange(context, node.to).end;
  return end ? Fix{"Write `BY -1`", {{end, end, " BY -1"}}, false} : Fix{};
}

void checkForBounds(Context& context, const ForStmt& node) {
  if (context.type(node.control) == types::kError) return;
  const bool is_signed = context.types().isSigned(context.types().plainKind(context.type(node.control)));
  const std::optional<int64_t> from = constantInteger(context, node.from), to = constantInteger(context, node.to);
  std::optional<int64_t> step = 1;
  if (node.step) {
    step = context.type(node.step) == types::kError ? std::nullopt : constantInteger(context, node.step);
    if (step == 0) {
      context.report(diag::StepZero, context.tree().begin(node.step));
      return;
    }
  }
  if (!from || !to || !step || context.library) return;
  const bool step_is_signed =
      !node.step || context.types().isSigned(context.types().plainKind(context.type(node.step)));
  const bool up = !step_is_signed || *step > 0;
  const auto less = [&](int64_t a, int64_t b) {
    return is_signed ? a < b : static_cast<uint64_t>(a) < static_cast<uint64_t>(b);
  };
  checkLastValue(context, node, *from, *to, *step);
  const bool never = up ? less(*to, *from) : less(*from, *to);
  if (never) {
    context
        .report(diag::LoopNeverRuns, context.tree().begin(node.from),
                {std::to_string(*from), std::to_string(*to), up ? "BY -1" : "a positive step"})
        .fix(node.step ? exchanged(context, node.from, node.to) : withStepBack(context, node))
        .fix(node.step ? Fix{} : exchanged(context, node.from, node.to));
  }
}

}  // namespace rung::sema
