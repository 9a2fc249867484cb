// SPDX-License-Identifier: Apache-2.0
#include "frontend/import/tool_comments.h"

#include <algorithm>

#include "frontend/source/scanner.h"

namespace rung::importer {
namespace {

// The `@WORD` at the start of a comment.
std::string_view tagOf(std::string_view comment) {
  comment.remove_prefix(std::min(comment.find_first_not_of(" \t", 2), comment.size()));
  if (!comment.starts_with("@")) return {};
  return comment.substr(0, comment.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_", 1));
}

}  // namespace

bool hasToolComment(std::string_view source, std::initializer_list<std::string_view> tags) {
  Scanner scanner(withoutMark(source));
  for (Unit unit = scanner.next(); unit.kind == UnitKind::Comment; unit = scanner.next())
    if (std::find(tags.begin(), tags.end(), tagOf(scanner.textOf(unit))) != tags.end()) return true;
  return false;
}

}  // namespace rung::importer
