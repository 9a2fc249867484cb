// SPDX-License-Identifier: Apache-2.0
// Forbids safe values of anything but outputs. The function marked {safe_values}, which the section [safe] of
// rung.project becomes, runs when the program has stopped, maybe in the middle of a cycle: it sees nothing but the
// output image.
//   passes  [safe] with `valve = TRUE`, where `valve AT %QX0.1 : BOOL`, or with `%QW3 = 100`
//   fails   [safe] with `Main.count = 0`                                                             E1290
// Called once, when all bodies are checked.
#include "sema/checks/rules.h"

#include "sema/project.h"

namespace rung::sema {

void checkSafeValues(Context& context) {
  const Project& project = context.project;
  for (const Project::GlobalWrite& write : project.global_writes) {
    const Pou& pou = project.pou(write.pou);
    if (!pou.pragmas.safe_values) continue;
    const Var& var = project.var(write.var);
    if (var.storage == Storage::Image && project.options.areas[var.image.area.index].owner == types::AreaOwner::Output)
      continue;
    context.report(diag::SafeTarget, pou.loc, {context.names().string(var.name)});
  }
}

}  // namespace rung::sema
