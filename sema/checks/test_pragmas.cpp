// SPDX-License-Identifier: Apache-2.0
// Forbids pragmas of tests that would have no effect. A function marked {setup} runs before each test of its file, one
// marked {teardown} after it; nothing gives them arguments.
//   passes  {setup} FUNCTION fill ...                  {test} {skip 'needs the new valve'} PROGRAM closes ...
//   fails   {setup} PROGRAM fill ...                                                              E1170
//   fails   {teardown} FUNCTION drain VAR_INPUT level : INT; END_VAR ...                          E1170
//   fails   {skip 'later'} FUNCTION Level ...                                                     E1171
//   fails   {test} METHOD fill ...                                                                E1186
#include "sema/checks/rules.h"

#include <algorithm>

#include "sema/declarations/collect.h"
#include "sema/declarations/variables.h"
#include "sema/fixes.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {
namespace {

// Forbids {test} where no test runs: methods, classes, interfaces, generic functions, types, lists of globals.
void checkTestForm(Context& context, const DeclHeader& decl, std::string_view what) {
  if (const Pragma* pragma = findPragma(context, decl, context.scopes.known_names.test))
    context.report(diag::TestForm, pragma->loc, {what}).length(pragma->end.offset - pragma->loc.offset);
}

void checkTestForms(Context& context) {
  for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) {
    const Pou& pou = context.symbols.pous[i];
    if (pou.library || !pou.decl) continue;
    if (pou.pragmas.test) resolvePou(context, PouId{i});  // shows whether it is generic
    const bool is_form =
        pou.kind == PouKind::Program || pou.kind == PouKind::Function || pou.kind == PouKind::FunctionBlock;
    if (!pou.owner && is_form && !pou.generic) continue;
    const std::string name = "`" + toString(context, pou.name) + "`";
    checkTestForm(context, context.tree().decl(pou.decl), pou.generic ? "the generic function " + name : name);
  }
  for (const FileUnit& unit : context.tree().files)
    for (const DeclId id : context.tree().list(unit.decls)) {
      if (context.tree().kind(id) == DeclKind::Section)
        checkTestForm(context, context.tree().decl(id), "a list of variables");
      if (context.tree().kind(id) == DeclKind::Type) checkTestForm(context, context.tree().decl(id), "a type");
    }
}

}  // namespace

void checkTestPragmas(Context& context) {
  Symbols& symbols = context.symbols;
  if (!context.project.options.mocks.empty()) return;  // was checked without mocks
  checkTestForms(context);
  for (uint32_t i = 1; i < symbols.pous.size(); ++i) {
    const Pou& pou = symbols.pous[i];
    if (pou.library) continue;
    const Pou::Pragmas& pragmas = pou.pragmas;
    const std::string_view name = context.names().string(pou.name);
    if (pragmas.skip && !pragmas.test)
      context.report(diag::SkipOutsideTest, pou.loc, {name}).fix(withPragma(context, pou.decl, "{test}"));
    if (!pragmas.setup && !pragmas.teardown) continue;
    resolvePou(context, PouId{i});
    const Pou& resolved = symbols.pous[i];
    const bool has_pins = std::any_of(resolved.vars.begin(), resolved.vars.end(), [&](VarId var) {
      const SectionKind section = symbols.var(var).section;
      return section == SectionKind::Input || section == SectionKind::Output || section == SectionKind::InOut;
    });
    if (resolved.kind != PouKind::Function || resolved.pragmas.test || resolved.owner || has_pins ||
        (resolved.result && context.types().kind(resolved.result) != types::TypeKind::None))
      context.report(diag::SetupForm, resolved.loc, {pragmas.setup ? "setup" : "teardown", name});
  }
}

}  // namespace rung::sema
