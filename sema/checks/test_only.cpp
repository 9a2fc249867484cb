// SPDX-License-Identifier: Apache-2.0
// Forbids the use of a POU marked {test_only}, or of a mock, in a POU that is not for tests: otherwise a program that
// moves its own clock could run in the plant.
//   passes  {test} PROGRAM opens_late … TEST_ADVANCE(T#100ms);
//   fails   PROGRAM Main … TEST_ADVANCE(T#100ms);          E0620
// Called for every call of a function and every named type.
#include "sema/checks/rules.h"

namespace rung::sema {

void checkTestOnly(Context& context, const UsedName& used) {
  if (!used.pou || context.library) return;
  const Pou& pou = context.symbols.pou(used.pou);
  // The type of an instance was reported where it is declared.
  if (!pou.pragmas.test_only || (used.is_call && pou.kind != PouKind::Function)) return;
  const Pou& user = context.symbols.pou(context.pou);
  if (user.pragmas.test || user.pragmas.test_only || user.pragmas.replaces) return;
  context.report(diag::TestOnly, used.loc, {context.names().string(pou.name)});
}

}  // namespace rung::sema
