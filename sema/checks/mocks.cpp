// SPDX-License-Identifier: Apache-2.0
// Forbids mocks that do not fit what they replace, and the use of anything else as a mock. A mock replaces a function
// or block in the tests that name it. It has the same pins and result, so each test is checked with the original; for
// `rung test`, tests with mocks are then checked and translated once more for each set of mocks (Options::mocks), where
// the replaced names mean the mocks. Layout, initial values and calls follow, in both engines.
//   passes  {replaces 'Level'} FUNCTION Full : REAL …   {test} {mock 'Full'} PROGRAM stops_when_full …
//   fails   {replaces 'Levl'} FUNCTION Full : REAL …                                             E0621
//   fails   {replaces 'Level'} FUNCTION_BLOCK Full …                                             E0622
//   fails   {replaces 'Level'} FUNCTION Full : INT …                                             E0623
//   fails   {test} {mock 'Ful'} PROGRAM stops_when_full …                                        E0624
//   fails   {test} {mock 'Full'} {mock 'Empty'} PROGRAM stops_when_full …                        E0625
//   fails   {mock 'Full'} PROGRAM Main …                                                         E0626
#include "sema/checks/rules.h"

#include <algorithm>

#include "sema/bodies/calls.h"
#include "sema/bodies/names.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/variables.h"
#include "sema/fixes.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// An error at a pragma underlines all of it.
Report reportPragma(Context& context, Diag diag, const Pragma& pragma, std::initializer_list<std::string_view> args) {
  Report report = context.report(diag, pragma.loc, args);
  report.length(pragma.end.offset - pragma.loc.offset);
  return report;
}

struct Pin {
  VarId var;
  std::string is;  // `VAR_INPUT INT`
};

std::vector<Pin> mockedPins(Context& context, PouId id) {
  std::vector<Pin> pins;
  for (const VarId var_id : context.symbols.pou(id).vars) {
    const Var& var = context.symbols.var(var_id);
    const char* const section = var.section == SectionKind::Input    ? "`VAR_INPUT "
                                : var.section == SectionKind::Output ? "`VAR_OUTPUT "
                                : var.section == SectionKind::InOut  ? "`VAR_IN_OUT "
                                                                     : nullptr;
    if (section != nullptr) pins.push_back({var_id, section + context.types().toString(var.type) + "`"});
  }
  return pins;
}

void compare(Context& context, PouId mock_id, PouId original_id) {
  Symbols& symbols = context.symbols;
  const Pou &mock = symbols.pou(mock_id), &original = symbols.pou(original_id);
  const std::string_view mock_name = context.names().string(mock.name),
                         original_name = context.names().string(original.name);
  const auto differs = [&](Loc loc, Loc there, std::string_view what, std::string_view is, std::string_view is_there) {
    Report report = context.report(diag::MockDiffers, loc, {what, is, mock_name, is_there, original_name});
    if (there) report.declaredHere(there);
  };
  const auto resultOf = [&](const Pou& pou) {
    return pou.result ? '`' + context.types().toString(pou.result) + '`' : std::string("missing");
  };
  if (resultOf(mock) != resultOf(original))
    differs(mock.loc, original.loc, "the result", resultOf(mock), resultOf(original));
  const std::vector<Pin> pins = mockedPins(context, mock_id), wanted = mockedPins(context, original_id);
  for (size_t i = 0; i < std::max(pins.size(), wanted.size()); ++i) {
    const Var* const pin = i < pins.size() ? &symbols.var(pins[i].var) : nullptr;
    const Var* const other = i < wanted.size() ? &symbols.var(wanted[i].var) : nullptr;
    if (pin != nullptr && other != nullptr && context.names().same(pin->name, other->name)) {
      if (pins[i].is == wanted[i].is) continue;
      const std::string what = "the pin `" + toString(context, pin->name) + "`";
      return differs(pin->loc, other->loc, what, pins[i].is, wanted[i].is);
    }
    const std::string what = "pin " + std::to_string(i + 1);
    const auto nameOf = [&](const Var* var) {
      return var == nullptr ? std::string("missing") : '`' + toString(context, var->name) + '`';
    };
    return differs(pin != nullptr ? pin->loc : mock.loc, other != nullptr ? other->loc : original.loc, what,
                   nameOf(pin), nameOf(other));
  }
}

bool canBeReplaced(const Pou& original, const Pou& mock) {
  return original.kind == mock.kind && mock.kind != PouKind::Program && !original.generic && !original.extensible &&
         original.pragmas.operator_kind == OperatorKind::None && !original.pragmas.test && !original.pragmas.replaces &&
         !mock.pragmas.test;
}

void checkReplaced(Context& context, PouId id, const Pragma& pragma) {
  const Entity found = findDotted(context, context.symbols.pou(id).pragmas.replaces);
  const Pou& mock = context.symbols.pou(id);
  std::string_view wanted = context.names().string(mock.pragmas.replaces);
  if (wanted.empty()) wanted = "...";
  if (found.entityKind() != EntityKind::Pou) {
    if (context.tree().lost_names) return;
    reportPragma(context, diag::MockOfUnknown, pragma, {wanted})
        .didYouMean(nearestName(context, mock.pragmas.replaces));
    return;
  }
  noteNameInPragma(context, found, pragma);
  const PouId original{found.index};
  if (!canBeReplaced(context.symbols.pou(original), mock)) {
    reportPragma(context, diag::MockOfOtherKind, pragma, {context.names().string(mock.name), wanted})
        .declaredHere(context.symbols.pou(original).loc);
    return;
  }
  if (isBroken(context, id) || isBroken(context, original)) return;
  resolvePou(context, id);
  compare(context, id, original);
}

}  // namespace

void checkMocks(Context& context) {
  Symbols& symbols = context.symbols;
  if (!context.project.options.mocks.empty()) return;  // was checked with the originals
  const Scopes::KnownNames& known = context.scopes.known_names;
  std::vector<bool> taken(symbols.pous.size());
  for (uint32_t i = 1; i < symbols.pous.size(); ++i) {
    const Pou& pou = symbols.pous[i];
    if (pou.library) continue;
    Context there = atPou(context, PouId{i});
    there.pou = {};
    std::vector<std::pair<uint32_t, PouId>> replaced;  // originals and their mocks
    for (const Pragma& pragma : context.tree().list(context.tree().decl(pou.decl).pragmas)) {
      const NameId key = keyOf(context, pragma.name);
      if (key == known.replaces) checkReplaced(there, PouId{i}, pragma);
      if (key != known.mock) continue;
      if (!pou.pragmas.test) {
        reportPragma(context, diag::MockOutsideTest, pragma, {context.names().string(pou.name)})
            .fix(withPragma(context, pou.decl, "{test}"));
        break;
      }
      const NameId name = context.names().intern(context.tree().string(pragma.value));
      const Entity found = lookUp(there, name);
      if (found.entityKind() != EntityKind::Pou || !symbols.pous[found.index].pragmas.replaces) {
        std::vector<std::string_view> mocks;
        for (const Pou& other : symbols.pous)
          if (other.pragmas.replaces) mocks.push_back(context.names().string(other.name));
        const std::string_view written = context.names().string(name);
        reportPragma(context, diag::NoMock, pragma, {written.empty() ? "..." : written})
            .didYouMean(nearest(written, mocks));
        continue;
      }
      noteNameInPragma(there, found, pragma);
      taken[found.index] = true;
      const Pou& mock = symbols.pous[found.index];
      Context at_mock = atPou(context, PouId{found.index});
      at_mock.pou = {};
      const Entity original = findDotted(at_mock, mock.pragmas.replaces);
      if (original.entityKind() != EntityKind::Pou) continue;  // reported at the mock
      for (const auto& [other, by] : replaced) {
        if (other != original.index) continue;
        reportPragma(context, diag::TwoMocks, pragma,
                     {context.names().string(symbols.pou(by).name), context.names().string(mock.name),
                      context.names().string(mock.pragmas.replaces)});
      }
      replaced.push_back({original.index, PouId{found.index}});
    }
  }
  if (symbols.diagnostics.hasErrors()) return;
  for (uint32_t i = 1; i < taken.size(); ++i) {
    const Pou& pou = symbols.pous[i];
    if (pou.pragmas.replaces && !taken[i])
      context.report(diag::MockUnused, pou.loc, {context.names().string(pou.name)});
  }
}

}  // namespace rung::sema
