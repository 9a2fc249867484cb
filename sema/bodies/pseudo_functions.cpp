// SPDX-License-Identifier: Apache-2.0
#include "sema/bodies/pseudo_functions.h"

#include <algorithm>

#include "sema/bodies/calls.h"
#include "sema/bodies/diagnostics.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

constexpr uint32_t kAny = ~0u;  // the function counts its arguments itself

struct Row {
  std::string_view name;
  uint32_t arguments;
  PseudoHandler* check;
  bool is_of_system = false;
};
// CODESYS: "the operator INDEXOF is not supported any longer; use ADR instead" (C0191).
TypeId refuseIndexOf(Context& context, ExprId& expr, const PseudoCall&) {
  const CallExpr& node = context.tree().as<CallExpr>(expr);
  context.report(diag::IndexOf, node.h.loc);
  return types::kError;
}

constexpr Row kFunctions[] = {
    {"ADR", 1, checkAdr},
    {"ASSERT", kAny, checkAssert},
    {"ASSERT_EQ", kAny, checkAssertEq},
    {"ASSERT_NEAR", kAny, checkAssertNear},
    {"BITADR", 1, checkBitAdr},
    {"INDEXOF", kAny, refuseIndexOf, true},
    {"LEN_MAX", 1, checkLengthLimit},
    {"LOWER_BOUND", 2, checkLowerBound},
    {"REF", 1, checkAdr},
    {"SIZEOF", 1, checkSizeOf},
    {"UPPER_BOUND", 2, checkUpperBound},
    {"VAL", 1, checkVal},
    {"XSIZEOF", 1, checkSizeOf},
    {"__DELETE", kAny, checkDelete},
    {"__ISVALIDREF", 1, checkIsValid},
    {"__POSITION", 0, checkPosition, true},
    {"__POUNAME", 0, checkPouName, true},
    {"__QUERYINTERFACE", 2, checkQueryInterface},
    {"__QUERYPOINTER", 2, checkQueryPointer},
    {"__VARINFO", 1, checkVarInfo, true},
};

}  // namespace

std::optional<TypeId> checkPseudoCall(Context& context, ExprId& expr, NameId name, bool as_statement) {
  const auto* row = std::find_if(std::begin(kFunctions), std::end(kFunctions),
                                 [&](const Row& candidate) { return isNamed(context, name, candidate.name); });
  if (row == std::end(kFunctions) || (row->is_of_system && !context.profile().system_operators)) return std::nullopt;
  const CallExpr& node = context.tree().as<CallExpr>(expr);
  const PseudoCall call{name, context.tree().list(node.arguments), as_statement};
  const bool all_given =
      std::all_of(call.arguments.begin(), call.arguments.end(), [](const Argument& a) { return bool{a.value}; });
  if (row->arguments != kAny && (call.arguments.size() != row->arguments || !all_given)) {
    context.report(diag::WrongArgumentCount, node.h.loc,
                   {string(context, name), std::to_string(row->arguments), std::to_string(call.arguments.size())});
    checkLooseArguments(context, node);
    return context.type(expr) = types::kError;
  }
  const TypeId type = row->check(context, expr, call);
  return context.type(expr) = type;
}

std::string_view nearestPseudoFunction(Context& context, NameId written) {
  std::vector<std::string_view> names;
  for (const Row& row : kFunctions) names.push_back(row.name);
  const std::string_view near = nearest(string(context, written), names);
  return near.empty() ? nearestByBeginning(string(context, written), names) : near;
}

}  // namespace rung::sema
