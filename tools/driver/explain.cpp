// `rung explain CODE`: the page of a diagnostic, from docs/errors, which is embedded in the tool, without Markdown.
#include <string_view>

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

int runExplain(const Options& options, Sink& sink) {
  const std::string code = upper(options.inputs[0]);
  const DiagInfo* info = findDiag(code);
  if (info == nullptr) {
    std::vector<std::string_view> codes;
    for (const DiagInfo& row : allDiags()) codes.push_back(row.code);
    std::string_view near = nearest(code, codes);
    return usageError(sink, "unknown diagnostic `" + options.inputs[0] + "`" +
                                (near.empty() ? "" : "; did you mean `" + std::string(near) + "`?"));
  }
  return printResult(sink, renderPage(pageOf(*info), options.color));
}

}  // namespace rung::driver
