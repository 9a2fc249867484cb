// SPDX-License-Identifier: Apache-2.0
// Forbids variables that live for one call, the result included, beyond 4 MiB: compiled code has them on its stack, of
// which a thread has 8 MiB on Linux.
//   passes  FUNCTION Sum : LREAL VAR_IN_OUT table : ARRAY[0..3000000] OF LREAL; END_VAR
//   fails   FUNCTION Zeros : Table              TYPE Table : ARRAY[0..3000000] OF LREAL; END_TYPE          E0588
// Called at the end of each body.
#include "sema/checks/rules.h"
#include "sema/shorthands.h"

namespace rung::sema {

void checkCallMemory(Context& context) {
  constexpr uint64_t kMostBytes = uint64_t{4} << 20;
  const Pou& pou = context.symbols.pou(context.pou);
  const bool is_function = pou.kind == PouKind::Function || pou.kind == PouKind::Method;
  uint64_t bytes = 0;
  const auto add = [&](VarId id) {
    const Var& var = context.symbols.var(id);
    if (!var.type || var.type == types::kError || var.section == SectionKind::InOut || var.section == SectionKind::Stat)
      return;
    if (is_function || var.section == SectionKind::Temp)
      bytes += context.types().info(context.types().resolve(var.type)).size;
  };
  for (const VarId id : pou.vars) add(id);
  if (pou.result_var) add(pou.result_var);
  if (bytes <= kMostBytes) return;
  context.report(diag::CallMemory, pou.loc,
                 {string(context, pou.name), std::to_string(bytes), std::to_string(kMostBytes)});
}

}  // namespace rung::sema
