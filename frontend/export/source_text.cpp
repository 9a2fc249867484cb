#include "frontend/export/source_text.h"

#include <algorithm>

#include "frontend/source/names.h"

namespace rung::plcopen {
namespace {

bool isWordChar(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

// The offset after a comment that begins at `p` with `(*` or `/*`; comments nest.
size_t endOfComment(std::string_view text, size_t p) {
  const char mark = text[p];
  const std::string_view open = mark == '(' ? "(*" : "/*", close = mark == '(' ? "*)" : "*/";
  size_t depth = 1, at = p + 2;
  while (at < text.size() && depth > 0) {
    const std::string_view two = text.substr(at, 2);
    if (two == open || two == close) {
      depth = two == open ? depth + 1 : depth - 1;
      at += 2;
    } else {
      ++at;
    }
  }
  return std::min(at, text.size());
}

}  // namespace

SourceText::SourceText(const Sources& sources, FileId file)
    : source_(sources.sourceText(file)), base_(sources.begin(file).offset) {
  for (size_t p = 0; p < source_.size();) {
    const char c = source_[p];
    const std::string_view two = source_.substr(p, 2);
    size_t end = p + 1;
    Kind kind = Kind::Punctuation;
    if (static_cast<unsigned char>(c) <= ' ') {
      ++p;
      continue;
    }
    if (two == "//") {
      kind = Kind::Comment;
      end = std::min(source_.find('\n', p), source_.size());
      if (source_[end - 1] == '\r') --end;
    } else if (two == "(*" || two == "/*") {
      kind = Kind::Comment;
      end = endOfComment(source_, p);
    } else if (c == '{') {
      kind = Kind::Pragma;
      end = std::min(source_.find('}', p), source_.size() - 1) + 1;
    } else if (c == '\'' || c == '"') {
      kind = Kind::Text;
      while (end < source_.size() && source_[end] != c) end += source_[end] == '$' ? 2 : 1;
      end = std::min(end + 1, source_.size());
    } else if (isWordChar(c)) {
      kind = Kind::Word;
      while (end < source_.size() && isWordChar(source_[end])) ++end;
    }
    units_.push_back({static_cast<uint32_t>(p), static_cast<uint32_t>(end), kind});
    p = end;
  }
}

size_t SourceText::unitAt(size_t p) const {
  return static_cast<size_t>(
      std::lower_bound(units_.begin(), units_.end(), p, [](const Unit& u, size_t at) { return u.begin < at; }) -
      units_.begin());
}

size_t SourceText::commentsBefore(size_t p, bool all) const {
  const size_t end = unitAt(p);
  size_t first = end;
  while (first > 0 && units_[first - 1].kind == Kind::Comment) --first;
  if (!all && first > 0)
    while (first < end && !lineEnds(units_[first - 1].end, units_[first].begin)) ++first;
  return first == end ? p : units_[first].begin;
}

size_t SourceText::commentsAfter(size_t p) const {
  size_t end = p;
  for (size_t i = unitAt(p); i < units_.size() && units_[i].kind == Kind::Comment; ++i) {
    if (lineEnds(end, units_[i].begin)) break;
    end = units_[i].end;
  }
  return end;
}

size_t SourceText::endWithComments(size_t p) const {
  size_t end = p, i = unitAt(p);
  for (; i < units_.size() && units_[i].kind == Kind::Comment; ++i) end = units_[i].end;
  return i < units_.size() && sameIdentifier(textOf(units_[i]).substr(0, 4), "END_") ? end : p;
}

std::vector<SourceText::Span> SourceText::commentsIn(size_t begin, size_t end) const {
  std::vector<Span> spans;
  for (size_t i = unitAt(begin); i < units_.size() && units_[i].end <= end; ++i)
    if (units_[i].kind == Kind::Comment) spans.push_back({units_[i].begin, units_[i].end});
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
    if (units_[i].kind == Kind::Word && sameIdentifier(textOf(units_[i]), word)) return units_[i].end;
  return source_.size();
}

size_t SourceText::wordBefore(size_t p, std::string_view word) const {
  for (size_t i = unitAt(p); i > 0; --i)
    if (units_[i - 1].kind == Kind::Word && sameIdentifier(textOf(units_[i - 1]), word)) return units_[i - 1].begin;
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
    if (unit.kind == Kind::Word) {
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
    } else if (unit.kind == Kind::Punctuation && text == ";" && structures == 0) {
      return unit.end;
    }
    if (unit.kind != Kind::Comment) end = unit.end;
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
    if (units_[i].kind != Kind::Punctuation) continue;
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

}  // namespace rung::plcopen
