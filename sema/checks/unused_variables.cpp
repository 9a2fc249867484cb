// SPDX-License-Identifier: Apache-2.0
// Warns of a local that is never read or written, of a local of a function or block that is read and never written, and
// of an output that its block never writes. Located variables, a program's own and the flags of a chart may be accessed
// from outside.
//   passes  VAR n : INT; END_VAR   n := n + 1;
//   fails   VAR n : INT; END_VAR   (nothing)
// Called once, when all bodies are checked; silent when there are errors, since uses may then be missing.
#include "sema/checks/rules.h"

#include "frontend/schedule/sfc_schedule.h"
#include "sema/declarations/objects.h"
#include "sema/fixes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// An object constructed by FB_Init may work without being named.
bool isCreatedByMethod(Context& context, TypeId type) {
  while (context.types().kind(type) == types::TypeKind::Array)
    type = context.types().info(context.types().resolve(type)).base;
  const PouId object = context.types().kind(type) == types::TypeKind::Record ? pouOf(context, type) : PouId{};
  return object && constructorOf(context, object);
}

}  // namespace

void checkUnusedVariables(Context& context) {
  if (context.symbols.diagnostics.hasErrors()) return;
  for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) {
    const Pou& pou = context.symbols.pous[i];
    if (pou.library || pou.pragmas.native || !pou.progress.checked() || !pou.decl) continue;
    if (pou.body.code.empty()) continue;
    for (const VarId id : pou.vars) {
      const Var& var = context.symbols.var(id);
      if (!var.name || var.temporary != 0 || var.storage == Storage::Image || var.open_address || var.constant ||
          var.of_chart || text::isSfcFlag(context.names().string(var.name)))
        continue;
      const bool local =
          var.section == SectionKind::Local || var.section == SectionKind::Temp || var.section == SectionKind::Stat;
      if (local && var.used.reads == 0 && var.used.writes == 0) {
        if (isCreatedByMethod(context, var.type)) continue;
        context.report(diag::UnusedVariable, var.loc, {string(context, var.name)}).fix(withoutVariable(context, var));
      } else if (local && var.used.writes == 0 && !var.init && var.start.constructor.index == 0 &&
                 pou.kind != PouKind::Program) {
        context.report(diag::NeverWritten, var.loc, {string(context, var.name)});
      } else if (var.section == SectionKind::Output && var.used.writes == 0 && !var.init) {
        context.report(diag::OutputNeverWritten, var.loc, {string(context, var.name), string(context, pou.name)});
      }
    }
  }
}

}  // namespace rung::sema
