// SPDX-License-Identifier: Apache-2.0
// `rung explain CODE`: the page of a diagnostic, from docs/errors, which is embedded in the tool, without Markdown; of
// a warning also by its name, or by the code of CODESYS, which may mean several.
#include <algorithm>
#include <string_view>
#include <vector>

#include "errors_pages.h"
#include "frontend/source/diagnostics.h"
#include "frontend/source/scanner.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/page.h"

namespace rung::driver {
namespace {

std::string pageOf(const DiagInfo& info) {
  std::string_view page = errorPage(info.code);
  return page.empty() ? std::string("# ") + info.code + "\n" + info.text + "\n" : std::string(page);
}

}  // namespace

std::string_view errorPage(std::string_view code) {
  for (size_t i = 0; i < embedded::errors_pages_count; i++) {
    std::string_view name = embedded::errors_pages[i].name;
    if (name.size() == code.size() + 3 && name.starts_with(code)) return embedded::errors_pages[i].text;
  }
  return {};
}

int runExplain(const std::string& wanted, bool color, Sink& sink) {
  std::vector<const DiagInfo*> found;
  for (const char* const letter : {"", "E", "W", "I"})  // 501 is E0501
    if (const DiagInfo* info =
            findDiag(letter + std::string(*letter != 0 ? 4 - std::min<size_t>(4, wanted.size()) : 0, '0') + wanted))
      found.push_back(info);
  if (found.empty())
    for (const Diag warning : warningsNamed(wanted)) found.push_back(&diagInfo(warning));
  if (found.empty()) {
    std::vector<std::string_view> codes;
    for (const DiagInfo& row : allDiags()) codes.push_back(row.code);
    const std::string code = upper(wanted), name = nearestWarning(wanted);
    std::string_view near = nearest(code, codes);
    if (near.empty()) near = name;
    return usageError(sink, "unknown diagnostic `" + wanted + "`" +
                                (near.empty() ? "" : "; did you mean `" + std::string(near) + "`?"));
  }
  std::string pages;
  for (const DiagInfo* const info : found) pages += (pages.empty() ? "" : "\n") + pageOf(*info);
  return printResult(sink, renderPage(pages, color));
}

}  // namespace rung::driver
