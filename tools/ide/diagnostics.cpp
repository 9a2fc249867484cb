// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/diagnostics.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "tools/driver/file_provider.h"

namespace rung::ide {
namespace {

// What these mark could be left out: an unused variable, an unreachable statement or step, a condition, value, mock or
// label that nothing uses, a statement without effect.
constexpr Diag kUnnecessary[] = {diagOf("W0758"), diagOf("W0753"), diagOf("W0763"), diagOf("W0747"),
                                 diagOf("W0762"), diagOf("W0651"), diagOf("W1430"), diagOf("W0885"),
                                 diagOf("W0253"), diagOf("W0644"), diagOf("W0650")};
constexpr Diag kDeprecated[] = {diagOf("W0647")};

template <size_t count>
bool isAmong(const Diag (&codes)[count], Diag diag) {
  return std::find(std::begin(codes), std::end(codes), diag) != std::end(codes);
}

FileDiagnostic fileDiagnostic(const View& view, const Diagnostic& of) {
  FileDiagnostic result{{}, {}, of.severity, diagInfo(of.diag).code, of.message, {}, &of};
  if (of.loc) result.at = of.length == 0 ? view.tokenInFile(of.loc) : view.bytesInFile(of.loc, of.length);
  if (result.at) result.path = view.pathOf(result.at.file);
  if (result.path.empty() && !of.path.empty()) result.path = driver::absolutePath(of.path);
  if (!of.element.empty()) result.message += "\nin " + of.element;
  for (const Diagnostic::Attached& note : of.notes) {
    if (const FileRange at = view.tokenInFile(note.loc))
      result.related.push_back({at, note.message});
    else
      result.message += "\n" + note.message;
  }
  result.is_unnecessary = isAmong(kUnnecessary, of.diag);
  result.is_deprecated = isAmong(kDeprecated, of.diag);
  return result;
}

}  // namespace

std::vector<FileDiagnostic> diagnosticsOf(const View& view) {
  std::vector<FileDiagnostic> all;
  for (const Diagnostic& diagnostic : view.snapshot().diagnostics()) {
    FileDiagnostic one = fileDiagnostic(view, diagnostic);
    std::error_code error;  // an opened folder without sources is not a mistake
    if (!one.path.empty() && (one.at || !std::filesystem::is_directory(one.path, error))) all.push_back(std::move(one));
  }
  return all;
}

}  // namespace rung::ide
