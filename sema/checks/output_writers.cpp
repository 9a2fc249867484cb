// SPDX-License-Identifier: Apache-2.0
// Warns of an output of the process image (AT %Q) that two POUs write: the last one in the cycle wins. Several writes
// in one POU, mostly in branches, are not reported. CODESYS Static Analysis SA0004 "Multiple write access on output";
// PLCopen coding rule CP12. Where the two run in different tasks, W0829 has spoken.
//   passes  one program computes `pump`, the only one that writes it
//   fails   two programs have `pump := ...;`
// Called once, when all bodies are checked. Linear in the writes.
#include "sema/checks/rules.h"

#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// The methods and actions of a block are one POU with it.
PouId outermost(const Project& project, PouId pou) {
  while (project.pou(pou).owner) pou = project.pou(pou).owner;
  return pou;
}

}  // namespace

void checkOutputWriters(Context& context) {
  const Project& project = context.project;
  if (project.diagnostics.hasErrors() || project.tasks.size() > 1) return;
  std::vector<PouId> writer(project.vars.size());
  std::vector<bool> reported(project.vars.size());
  for (const Project::GlobalWrite& write : project.global_writes) {
    const Var& var = project.var(write.var);
    if (var.storage != Storage::Image || !var.name || reported[write.var.index]) continue;
    if (project.options.areas[var.image.area.index].owner != types::AreaOwner::Output) continue;
    const PouId pou = outermost(project, write.pou);
    const Pou& by = project.pou(pou);
    if (by.library || by.pragmas.test || by.pragmas.test_only || by.pragmas.safe_values) continue;
    PouId& first = writer[write.var.index];
    if (!first) first = pou;
    if (first == pou) continue;
    context.report(diag::OutputWritten, var.loc,
                   {string(context, var.name), string(context, project.pou(first).name), string(context, by.name)});
    reported[write.var.index] = true;
  }
}

}  // namespace rung::sema
