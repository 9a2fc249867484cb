// SPDX-License-Identifier: Apache-2.0
#include "frontend/export/source_text.h"

#include <algorithm>

#include "frontend/source/names.h"

namespace rung::exporter {
SourceText::SourceText(const Sources& sources, FileId file)
    : source_(sources.sourceText(file)), base_(sources.begin(file).offset) {
  Scanner scanner(source_);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next()) units_.push_back(unit);
}

size_t SourceText::unitAt(size_t p) const {
  return static_cast<size_t>(
      std::lower_bound(units_.begin(), units_.end(), p, [](const Unit& u, size_t at) { return u.begin < at; }) -
      units_.begin());
}

size_t SourceText::commentsBefore(size_t p, bool all) const {
  const size_t end = unitAt(p);
  size_t first = end;
  while (first > 0 && units_[first - 1].kind == UnitKind::Comment) --first;
  if (!all && first > 0)
    while (first < end && !lineEnds(units_[first - 1].end, units_[first].begin)) ++first;
  return first == end ? p : units_[first].begin;
}

size_t SourceText::commentsAfter(size_t p) const {
  size_t end = p;
  for (size_t i = unitAt(p); i < units_.size() && units_[i].kind == UnitKind::Comment; ++i) {
    if (lineEnds(end, units_[i].begin)) break;
    end = units_[i].end;
  }
  return end;
}

size_t SourceText::endWithComments(size_t p) const {
  size_t end = p, i = unitAt(p);
  for (; i < units_.size() && units_[i].kind == UnitKind::Comment; ++i) end = units_[i].end;
  return i < units_.size() && sameIdentifier(textOf(units_[i]).substr(0, 4), "END_") ? end : p;
}

std::vector<SourceText::Span> SourceText::commentsIn(size_t begin, size_t end) const {
  std::vector<Span> spans;
  for (size_t i = unitAt(begin); i < units_.size() && units_[i].end <= end; ++i)
    if (units_[i].kind == UnitKind::Comment) spans.push_back({units_[i].begin, units_[i].end});
  return spans;
}

std::string SourceText::comments(size_t begin, size_t end) const {
  std::string out;
  for (const Span& span : commentsIn(begin, end)) {
    std::string_view comment = cut(span.begin, span.end);
    if (comment.starts_with("//")) {
      comment.remove_prefix(std::min(comment.find_first_not_of('/'), comment.size()));
    } else {
      comment.remove_prefix(2);
      if (comment.ends_with("*)") || comment.ends_with("*/")) comment.remove_suffix(2);
    }
    for (size_t p = 0; p <= comment.size();) {
      const size_t line_end = std::min(comment.find('\n', p), comment.size());
      std::string_view line = comment.substr(p, line_end - p);
      while (!line.empty() && static_cast<unsigned char>(line.back()) <= ' ') line.remove_suffix(1);
      while (!line.empty() && static_cast<unsigned char>(line.front()) <= ' ') line.remove_prefix(1);
      if (!line.empty()) out.append(out.empty() ? "" : "\n").append(line);
      p = line_end + 1;
    }
  }
  return out;
}

size_t SourceText::endOfWord(size_t p, std::string_view word) const {
  for (size_t i = unitAt(p); i < units_.size(); ++i)
    if (units_[i].kind == UnitKind::Name && sameIdentifier(textOf(units_[i]), word)) return units_[i].end;
  return source_.size();
}

size_t SourceText::wordBefore(size_t p, std::string_view word) const {
  for (size_t i = unitAt(p); i > 0; --i)
    if (units_[i - 1].kind == UnitKind::Name && sameIdentifier(textOf(units_[i - 1]), word)) return units_[i - 1].begin;
  return p;
}

bool SourceText::wordFollows(size_t p, std::string_view word) const {
  const size_t i = unitAt(p);
  return i < units_.size() && sameIdentifier(textOf(units_[i]).substr(0, word.size()), word);
}

size_t SourceText::endOfDeclaration(size_t p) const {
  size_t structures = 0, end = p;
  for (size_t i = unitAt(p); i < units_.size(); ++i) {
    const Unit& unit = units_[i];
    const std::string_view text = textOf(unit);
    if (unit.kind == UnitKind::Name) {
      if (sameIdentifier(text, "STRUCT") || sameIdentifier(text, "UNION")) ++structures;
      if (sameIdentifier(text, "END_STRUCT") || sameIdentifier(text, "END_UNION")) {
        if (structures == 0) return end;
        if (--structures == 0) {  // a `;` or a value may follow
          const bool more =
              i + 1 < units_.size() && (source_[units_[i + 1].begin] == ';' || source_[units_[i + 1].begin] == ':');
          if (!more) return unit.end;
        }
      }
      if (structures == 0 && (sameIdentifier(text, "END_VAR") || sameIdentifier(text, "END_TYPE"))) return end;
    } else if (unit.kind == UnitKind::Other && text == ";" && structures == 0) {
      return unit.end;
    }
    if (unit.kind != UnitKind::Comment) end = unit.end;
  }
  return end;
}

size_t SourceText::endOfPragma(size_t p) const {
  const size_t i = unitAt(p);
  return i < units_.size() ? units_[i].end : p;
}

SourceText::Span SourceText::parenthesesAround(size_t from, size_t p) const {
  size_t depth = 0, open = 0;
  for (size_t i = unitAt(from); i < units_.size(); ++i) {
    if (units_[i].kind != UnitKind::Other) continue;
    const char c = source_[units_[i].begin];
    if (c == '(' || c == '[') {
      if (depth++ == 0) open = units_[i].begin;
    } else if ((c == ')' || c == ']') && depth > 0 && --depth == 0) {
      if (open <= p && p < units_[i].begin) return {open + 1, units_[i].begin};
    }
    if (depth == 0 && units_[i].begin > p) break;
  }
  return {p, p};
}

}  // namespace rung::exporter
