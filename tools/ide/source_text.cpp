// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/source_text.h"

#include <algorithm>
#include <vector>

#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::ide {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlankCharacter(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlankCharacter(text.back())) text.remove_suffix(1);
  return text;
}

// The line that ends before `end`, which is the beginning of a line.
std::string_view lineBefore(std::string_view source, size_t end) {
  if (end == 0) return {};
  size_t last = end - 1;
  if (last > 0 && source[last] == '\n' && source[last - 1] == '\r') --last;
  const size_t begin = source.find_last_of("\r\n", last == 0 ? 0 : last - 1);
  const size_t first = begin == std::string_view::npos || last == 0 ? 0 : begin + 1;
  return source.substr(first, last - first);
}

size_t beginOfLine(std::string_view source, size_t at) {
  const size_t before = at == 0 ? std::string_view::npos : source.find_last_of("\r\n", at - 1);
  return before == std::string_view::npos ? 0 : before + 1;
}

// The text of `// …` or `/// …` lines that end directly above, in order.
std::string lineComments(std::string_view source, size_t line, std::string_view mark) {
  std::vector<std::string_view> lines;
  for (;;) {
    const std::string_view above = lineBefore(source, line);
    const std::string_view text = trimmed(above);
    if (!text.starts_with(mark)) break;
    lines.push_back(trimmed(text.substr(mark.size())));
    line = static_cast<size_t>(above.data() - source.data());
  }
  std::string out;
  for (auto at = lines.rbegin(); at != lines.rend(); ++at) out += (out.empty() ? "" : "\n") + std::string(*at);
  return out;
}

// The text of a comment `(* … *)` or `/* … */`, with the stars at the beginnings of its lines left out.
std::string blockComment(std::string_view comment) {
  comment = trimmed(comment.substr(2, comment.size() - 4));
  std::string out;
  while (!comment.empty()) {
    const size_t end = std::min(comment.find('\n'), comment.size());
    std::string_view line = trimmed(comment.substr(0, end));
    while (line.starts_with('*')) line.remove_prefix(1);
    out += (out.empty() ? "" : "\n") + std::string(trimmed(line));
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
  return out;
}

}  // namespace

std::string documentationAbove(std::string_view source, size_t declaration) {
  const size_t line = beginOfLine(source, declaration);
  const std::string_view before_it = trimmed(source.substr(line, declaration - line));
  if (!before_it.empty() && !sameIdentifier(before_it, "TYPE")) return {};  // something precedes it on its line
  if (std::string doc = lineComments(source, line, "///"); !doc.empty()) return doc;
  if (std::string doc = lineComments(source, line, "//"); !doc.empty()) return doc;
  const std::string_view before = source.substr(0, line);
  const size_t last = before.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos || last < 3) return {};
  if (std::count(before.begin() + static_cast<ptrdiff_t>(last), before.end(), '\n') > 1) return {};
  const bool is_star = before.substr(0, last + 1).ends_with("*)");
  if (!is_star && !before.substr(0, last + 1).ends_with("*/")) return {};
  const size_t begin = before.rfind(is_star ? "(*" : "/*", last - 2);
  return begin == std::string_view::npos ? std::string() : blockComment(before.substr(begin, last + 1 - begin));
}

// The `///` lines from one on.
static std::string docLinesFrom(std::string_view source, size_t line) {
  std::string out;
  while (line < source.size()) {
    const size_t end = std::min(source.find('\n', line), source.size());
    const std::string_view text = trimmed(source.substr(line, end - line));
    if (!text.starts_with("///")) break;
    out += (out.empty() ? "" : "\n") + std::string(trimmed(text.substr(3)));
    line = end + 1;
  }
  return out;
}

std::string documentationOf(const Sources& sources, const DeclHeader& declaration) {
  const FileId file = sources.fileOf(declaration.begin);
  if (!file) return {};
  const std::string_view source = sources.original(file);
  const uint32_t base = sources.begin(file).offset;
  if (declaration.doc && declaration.doc > declaration.loc) {  // after it
    const size_t begin = declaration.doc.offset - base;
    const std::string_view line = source.substr(begin, source.find_first_of("\r\n", begin) - begin);
    return std::string(trimmed(line.substr(std::min<size_t>(3, line.size()))));
  }
  if (declaration.doc) return docLinesFrom(source, declaration.doc.offset - base);
  return documentationAbove(source, declaration.begin.offset - base);
}

std::string sourceOnOneLine(const Sources& sources, Range range) {
  const FileId file = sources.fileOf(range.begin);
  if (!file || range.end <= range.begin) return {};
  const size_t begin = range.begin.offset - sources.begin(file).offset;
  const std::string_view source = sources.sourceText(file).substr(begin, range.end.offset - range.begin.offset);
  std::string out;
  Scanner scanner(source);
  size_t last = 0;
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next()) {
    if (unit.kind == UnitKind::Comment) continue;
    if (!out.empty() && unit.begin > last) out += ' ';
    out += scanner.textOf(unit);
    last = unit.end;
  }
  return out;
}

}  // namespace rung::ide
