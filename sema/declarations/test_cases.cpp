// SPDX-License-Identifier: Apache-2.0
// Cases of tests: see test_cases.h. The values have the form and the rules of initial values.
//   passes  {test} {case a := 1, b := 2, sum := 3} PROGRAM adds VAR_INPUT a, b, sum : INT; END_VAR …
//   fails   {case a := 1} PROGRAM adds …                                    E1180
//   fails   {test} {case} PROGRAM adds …                                    E1181
//   fails   {test} {case c := 1} PROGRAM adds …                             E1182
//   fails   {test} {case a := 1, a := 2} PROGRAM adds …                     E1183
//   fails   {test} {case a := 1} {case a := 1} PROGRAM adds …               E1184
//   fails   {test} {case a := 1} PROGRAM adds VAR_IN_OUT sum : INT; …       E1185
#include "sema/declarations/test_cases.h"

#include <algorithm>

#include "frontend/parse/parse.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/initial_values.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/variables.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {
namespace {

bool isBlank(char c) { return static_cast<unsigned char>(c) <= ' '; }

// The text in one line, as part of the test's name.
std::string onOneLine(std::string_view text) {
  std::string line;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0 ? c == quote : c == '\'' || c == '"') quote = quote != 0 ? '\0' : c;
    const bool blank = quote == 0 && isBlank(c);
    if (blank && (line.empty() || line.back() == ' ')) continue;
    line += blank ? ' ' : c;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

struct CaseResolver {
  Context& context;  // seen from the test
  PouId test;

  const Pou& pou() const { return context.symbols.pou(test); }
  std::string_view string(NameId name) const { return context.names().string(name); }
  Report report(Diag diag, const Pragma& pragma, std::initializer_list<std::string_view> args) const {
    Report report = context.report(diag, pragma.loc, args);
    report.length(pragma.end.offset - pragma.loc.offset);
    return report;
  }

  // Between the word and the brace; empty for another form of the pragma, such as {attribute 'case' := …}.
  std::string_view contentOf(const Pragma& pragma, Loc& begin) const {
    const Sources& sources = context.symbols.sources;
    const FileId file = sources.fileOf(pragma.loc);
    const uint32_t at = pragma.loc.offset - sources.begin(file).offset, end = pragma.end.offset - pragma.loc.offset;
    const std::string_view text = sources.sourceText(file).substr(at, end - 1);  // without the brace
    const std::string_view word = string(pragma.name);
    size_t from = 1;
    while (from < text.size() && isBlank(text[from])) ++from;
    if (!sameIdentifier(text.substr(from, word.size()), word)) return {};
    from += word.size();
    begin = Loc{pragma.loc.offset + static_cast<uint32_t>(from)};
    return text.substr(from);
  }

  void unknownInput(const Ident& name) const {
    std::vector<std::string_view> inputs;
    for (const VarId id : pou().vars)
      if (context.symbols.var(id).section == SectionKind::Input) inputs.push_back(string(context.symbols.var(id).name));
    Report report = context.report(diag::CaseInput, name.loc, {string(name.name), string(pou().name)});
    const std::string_view near = nearest(string(name.name), inputs);
    if (const VarId other = findPin(context, test, name.name))
      report.declaredHere(context.symbols.var(other).loc);
    else
      report.didYouMean(near);
  }

  void addInput(const FieldInit& written, TestCase& to) const {
    const VarId id = findPin(context, test, written.field.name);
    if (!id || context.symbols.var(id).section != SectionKind::Input) return unknownInput(written.field);
    const bool twice =
        std::any_of(to.inputs.begin(), to.inputs.end(), [&](const TestCase::Input& given) { return given.var == id; });
    if (twice) {
      context.report(diag::CaseInputTwice, written.field.loc, {string(written.field.name)});
      return;
    }
    noteMention(context, entity(id), written.field.loc, Access::Pin);
    const Var& var = context.symbols.var(id);
    ExprId value = context.code().copy(written.value);
    checkInitializerAs(context, value, var.type, "the value of `" + toString(context, var.name) + "`");
    to.inputs.push_back({id, value});
  }

  // Forbids pins that a test cannot bind to a variable, since nothing calls it.
  bool hasReferences(const Pragma& pragma) const {
    for (const VarId id : pou().vars) {
      const Var& var = context.symbols.var(id);
      const bool is_open =
          var.section == SectionKind::Input && context.types().isOpenArray(context.types().resolve(var.type));
      const bool is_any = var.section == SectionKind::Input && var.any;
      if (var.section != SectionKind::InOut && !is_open && !is_any) continue;
      const char* const what = is_open ? "ARRAY[*]" : is_any ? "input of any type" : "VAR_IN_OUT";
      report(diag::CaseOfReference, pragma, {string(pou().name), what, string(var.name)}).declaredHere(var.loc);
      return true;
    }
    return false;
  }

  void add(const Pragma& pragma) const {
    Loc begin;
    const std::string_view content = contentOf(pragma, begin);
    const std::string line = onOneLine(content);
    if (line.empty()) {
      report(diag::CaseForm, pragma, {});
      return;
    }
    TestCase added{.name = context.names().intern(toString(context, pou().unique_name) + "(" + line + ")"),
                   .loc = pragma.loc,
                   .inputs = {}};
    std::vector<TestCase>& cases = context.symbols.pou(test).pragmas.cases;
    for (const TestCase& other : cases) {
      if (other.name != added.name) continue;
      report(diag::CaseTwice, pragma, {line}).alsoDeclaredHere(other.loc);
      return;
    }
    const Loc end{begin.offset + static_cast<uint32_t>(content.size())};
    const Slice<FieldInit> written =
        text::parseFieldInits(context.symbols.arena, context.names(), context.symbols.sources, begin, end,
                              context.symbols.profile.dialect, context.symbols.diagnostics);
    for (uint32_t i = 0; i < written.count; ++i) addInput(context.tree().list(written)[i], added);
    context.symbols.pou(test).pragmas.cases.push_back(std::move(added));
  }
};

}  // namespace

void resolveTestCases(Context& context) {
  const NameId known = context.scopes.known_names.test_case;
  for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) {
    const Pou& pou = context.symbols.pous[i];
    if (pou.library || !pou.decl) continue;
    Context there = atPou(context, PouId{i});
    const CaseResolver resolver{there, PouId{i}};
    for (const Pragma& pragma : context.tree().list(context.tree().decl(pou.decl).pragmas)) {
      if (keyOf(context, pragma.name) != known) continue;
      if (!pou.pragmas.test) {
        resolver.report(diag::CaseOutsideTest, pragma, {context.names().string(pou.name)});
        break;
      }
      if (isBroken(context, PouId{i})) break;
      resolvePou(context, PouId{i});
      if (resolver.hasReferences(pragma)) break;
      resolver.add(pragma);
    }
  }
}

}  // namespace rung::sema
