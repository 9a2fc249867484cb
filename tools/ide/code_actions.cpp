// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/code_actions.h"

#include <algorithm>

#include "frontend/source/fixes.h"

namespace rung::ide {
namespace {

bool touches(const FileRange& a, const FileRange& b) {
  return a.file == b.file && a.begin <= b.end && b.begin <= a.end;
}

// Empty: a place is not in a file, or in one of a library.
std::vector<TextEdit> textEdits(const View& view, const Diagnostic& diagnostic, const Fix& fix) {
  std::vector<TextEdit> edits;
  for (FileEdit& edit : fileEdits(view.sources(), diagnostic, fix)) {
    if (!view.sources().displayPath(edit.file).starts_with('/')) return {};
    edits.push_back({{edit.file, edit.begin, edit.end}, std::move(edit.text)});
  }
  return edits;
}

bool isInsideCharacter(std::string_view text, size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
}

}  // namespace

std::vector<CodeAction> quickFixes(const View& view, const std::vector<FileDiagnostic>& diagnostics,
                                   const FileRange& range) {
  std::vector<CodeAction> actions;
  for (const FileDiagnostic& diagnostic : diagnostics) {
    if (!touches(diagnostic.at, range)) continue;
    for (const Fix& fix : diagnostic.of->fixes)
      if (std::vector<TextEdit> edits = textEdits(view, *diagnostic.of, fix); !edits.empty())
        actions.push_back({fix.title, ActionKind::QuickFix, fix.is_sure, std::move(edits), &diagnostic});
  }
  return actions;
}

CodeAction fixAll(const View& view, FileId file, const workspace::Fixed& fixed) {
  CodeAction action{"Apply all sure fixes", ActionKind::FixAll, false, {}, nullptr};
  const auto found = fixed.files.find(view.pathOf(file));
  if (found == fixed.files.end() || found->second.before != view.textOf(file)) return action;
  const std::string_view before = found->second.before, after = found->second.after;
  const size_t shorter = std::min(before.size(), after.size());
  size_t first = 0, last = 0;  // the equal bytes at the begin and the end
  while (first < shorter && before[first] == after[first]) ++first;
  while (first > 0 && isInsideCharacter(before, first)) --first;
  while (last < shorter - first && before[before.size() - last - 1] == after[after.size() - last - 1]) ++last;
  while (last > 0 && isInsideCharacter(before, before.size() - last)) --last;
  const FileRange range{file, static_cast<uint32_t>(first), static_cast<uint32_t>(before.size() - last)};
  action.edits = {{range, std::string(after.substr(first, after.size() - last - first))}};
  return action;
}

}  // namespace rung::ide
