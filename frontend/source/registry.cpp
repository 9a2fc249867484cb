// SPDX-License-Identifier: Apache-2.0
// The registry of messages: the rows of every folder in one table, by number. In: the diagnostics.def files. Out:
// diagInfo(), findDiag() and allDiags() of diagnostics.h. The lists of later layers that it includes hold rows and no
// code.
#include <algorithm>
#include <array>
#include <iterator>

#include "frontend/source/diagnostics.h"
#include "frontend/source/names.h"

#undef RUNG_ERROR
#undef RUNG_WARNING
#undef RUNG_INFO
#undef RUNG_NOTE
#define RUNG_ERROR(code, name, text) {diagOf(#code), #code, #name, text, Severity::Error},
#define RUNG_WARNING(code, name, text) {diagOf(#code), #code, #name, text, Severity::Warning},
#define RUNG_INFO(code, name, text) {diagOf(#code), #code, #name, text, Severity::Info},
#define RUNG_NOTE(name, text)
#define RUNG_RULE(hook, file, function)

namespace rung {
namespace {

constexpr DiagInfo kRows[] = {
#include "frontend/export/diagnostics.def"
#include "frontend/import/diagnostics.def"
#include "frontend/parse/diagnostics.def"
#include "frontend/schedule/diagnostics.def"
#include "frontend/syntax/diagnostics.def"
#include "ir/diagnostics.def"
#include "sema/bodies/diagnostics.def"
#include "sema/checks/rules.def"
#include "sema/declarations/diagnostics.def"
#include "sema/diagnostics.def"
#include "tools/driver/diagnostics.def"
};

constexpr auto kByNumber = [] {
  std::array<DiagInfo, std::size(kRows)> rows{};
  std::copy(std::begin(kRows), std::end(kRows), rows.begin());
  std::sort(rows.begin(), rows.end(), [](const DiagInfo& a, const DiagInfo& b) { return a.diag < b.diag; });
  return rows;
}();

static_assert(std::adjacent_find(kByNumber.begin(), kByNumber.end(),
                                 [](const DiagInfo& a, const DiagInfo& b) { return a.diag == b.diag; }) ==
                  kByNumber.end(),
              "two rows have one code");

}  // namespace

const DiagInfo& diagInfo(Diag diag) {
  return *std::lower_bound(kByNumber.begin(), kByNumber.end(), diag,
                           [](const DiagInfo& row, Diag wanted) { return row.diag < wanted; });
}

const DiagInfo* findDiag(std::string_view code) {
  for (const DiagInfo& row : kByNumber)
    if (sameIdentifier(row.code, code)) return &row;
  return nullptr;
}

std::span<const DiagInfo> allDiags() { return kByNumber; }

std::vector<Diag> warningsNamed(std::string_view name) {
  struct Row {
    const char *codesys, *own;
  };
#define RUNG_CODESYS(code, own) {code, own},
  static constexpr Row kCodesys[] = {
#include "frontend/source/codesys_warnings.def"
  };
  std::vector<Diag> found;
  for (const Row& row : kCodesys)
    if (sameIdentifier(row.codesys, name)) found.push_back(findDiag(row.own)->diag);
  for (const DiagInfo& row : kByNumber)
    if (row.severity != Severity::Error && (sameIdentifier(row.code, name) || sameIdentifier(switchName(row), name)))
      found.push_back(row.diag);
  return found;
}

bool isCodesysCode(std::string_view name) {
  return name.size() > 1 && foldedCharacter(name[0]) == 'c' &&
         name.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

std::string nearestWarning(std::string_view name) {
  std::vector<std::string> names;
  for (const DiagInfo& row : kByNumber)
    if (row.severity != Severity::Error) names.push_back(switchName(row));
  return std::string(nearest(name, {names.begin(), names.end()}));
}

}  // namespace rung
