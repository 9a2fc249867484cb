// SPDX-License-Identifier: Apache-2.0
// Warns of a local variable with the name of a global of the project: the bare name means the local one, and a reader,
// or a later deletion of the local, takes the other. CODESYS Static Analysis SA0013 "Declarations with the same
// variable name". Pins are not reported: a block is written without knowledge of the project's globals.
//   passes  VAR_EXTERNAL level : INT; END_VAR             with VAR_GLOBAL level : INT
//   fails   PROGRAM Main VAR level : INT; END_VAR         with VAR_GLOBAL level : INT
// Called once, when all bodies are checked.
#include "sema/checks/rules.h"

#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

void checkHiddenGlobals(Context& context) {
  const Project& project = context.project;
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const Pou& pou = project.pous[i];
    if (pou.library || !pou.decl || pou.pragmas.test) continue;
    for (const VarId id : pou.vars) {
      const Var& var = project.var(id);
      const bool is_local =
          var.section == SectionKind::Local || var.section == SectionKind::Temp || var.section == SectionKind::Stat;
      if (!is_local || !var.name || var.temporary != 0 || var.external || var.of_chart) continue;
      const Entity found = context.scopes.globals.find(keyOf(context, var.name));
      if (found.entityKind() != EntityKind::Var || found.index == id.index) continue;
      const Var& global = project.var({found.index});
      if (global.storage != Storage::Global || !global.loc) continue;
      context.report(diag::GlobalHidden, var.loc, {string(context, var.name)}).declaredHere(global.loc);
    }
  }
}

}  // namespace rung::sema
