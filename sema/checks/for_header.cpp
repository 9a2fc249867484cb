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
  if (!enumeration && (types::TypeTable::isInteger(kind) || (types::TypeTable::isBits(kind) && !context.iec()))) {
    return type;
  }
  context.report(diag::ControlNotInteger, context.tree().loc(node.control), {context.types().toString(type)});
  return types::kError;
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
  const bool never = up ? less(*to, *from) : less(*from, *to);
  if (never) {
    context.report(diag::LoopNeverRuns, context.tree().begin(node.from),
                   {std::to_string(*from), std::to_string(*to), up ? "BY -1" : "a positive step"});
  }
}

}  // namespace rung::sema
