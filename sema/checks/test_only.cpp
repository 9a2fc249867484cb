// Forbids a call of a POU marked {test_only} in a POU that is no test: a program that moves its own clock would run
// otherwise in the plant. Design §11.
//   passes  {test} PROGRAM opens_late … TEST_ADVANCE(T#100ms);
//   fails   PROGRAM Main … TEST_ADVANCE(T#100ms);          E0620
// Called by calls.cpp for every call of a function.
#include "sema/checks/test_only.h"

namespace rung::sema {

void checkTestOnly(Context& context, const CallExpr& node, PouId callee) {
  const Pou& pou = context.project.pou(callee);
  if (!pou.test_only || context.project.pou(context.pou).test) return;
  context.report(Diag::TestOnly, node.h.loc, {text(context, pou.name)});
}

}  // namespace rung::sema
