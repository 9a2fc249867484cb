// SPDX-License-Identifier: Apache-2.0
// Warns of a program that no task runs and nothing calls. TM/TP manual 5.1: it is compiled, but never executed.
//   passes  PROGRAM Main, where it has a task in the CONFIGURATION, or where another program calls it
//   warns   PROGRAM Spare, where only Main has one
#include "sema/checks/rules.h"
#include "sema/project.h"

namespace rung::sema {

void checkProgramsRun(Context& context) {
  Project& project = context.project;
  if (project.instances.empty()) return;
  std::vector<bool> runs(project.pous.size());
  for (const ProgramInstance& instance : project.instances) runs[instance.program.index] = true;
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const Pou& pou = project.pous[i];
    if (pou.kind != PouKind::Program || pou.library || pou.pragmas.test || pou.pragmas.after_globals ||
        pou.progress.used || runs[i])
      continue;
    context.report(diag::ProgramNeverRuns, pou.loc, {project.names.string(pou.name)});
  }
}

}  // namespace rung::sema
