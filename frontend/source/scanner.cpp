// SPDX-License-Identifier: Apache-2.0
#include "frontend/source/scanner.h"

#include <algorithm>

#include "frontend/source/names.h"
#include "frontend/source/nested_comments.h"

namespace rung {
namespace {

bool isDecimal(char c) { return c >= '0' && c <= '9'; }

bool isWordCharacter(char c) { return isNameCharacter(c) || static_cast<unsigned char>(c) >= 0x80; }

}  // namespace

size_t endOfComment(std::string_view source, size_t at, bool nests) {
  const char open = source[at], close = open == '(' ? ')' : '/';
  uint32_t depth = 0;
  for (size_t i = at; i + 1 < source.size(); ++i) {
    if (source[i] == open && source[i + 1] == '*' && (nests || depth == 0)) {
      ++depth;
      ++i;
    } else if (source[i] == '*' && source[i + 1] == close) {
      ++i;
      if (--depth == 0) return i + 1;
    }
  }
  return source.size();
}

size_t endOfString(std::string_view source, size_t at) {
  const char quote = source[at++];
  while (at < source.size() && source[at] != quote && source[at] != '\n') at += source[at] == '$' ? 2 : 1;
  if (at >= source.size()) return source.size();
  return source[at] == quote ? at + 1 : at;
}

size_t endOfPragma(std::string_view source, size_t at) {
  for (size_t i = at + 1; i < source.size(); ++i) {
    if (source[i] == '}') return i + 1;
    if (source[i] != '\'' && source[i] != '"') continue;
    const size_t close = source.find_first_of(source[i] == '"' ? "\"\n" : "'\n", i + 1);
    if (close != std::string_view::npos && source[close] == source[i]) i = close;
  }
  return source.size();
}

Unit Scanner::next() {
  const size_t end = source_.size();
  while (at_ < end && isBlankCharacter(source_[at_])) ++at_;
  if (at_ >= end) return {UnitKind::End, end, end};
  const size_t begin = at_;
  const char c = source_[begin], after = begin + 1 < end ? source_[begin + 1] : '\0';
  UnitKind kind = UnitKind::Other;
  at_ = begin + 1;
  if (c == '/' && after == '/') {
    kind = UnitKind::Comment;
    at_ = std::min(source_.find('\n', begin), end);
    if (source_[at_ - 1] == '\r') --at_;
  } else if ((c == '(' || c == '/') && after == '*') {
    kind = UnitKind::Comment;
    at_ = endOfComment(source_, begin, nests_);
    if (const char* const nesting = nestingOf(source_.substr(begin, at_ - begin))) nests_ = *nesting == 'Y';
  } else if (c == '{') {
    kind = UnitKind::Pragma;
    at_ = endOfPragma(source_, begin);
  } else if (c == '\'' || c == '"') {
    kind = UnitKind::String;
    at_ = endOfString(source_, begin);
  } else if (isWordCharacter(c)) {
    kind = isDecimal(c) ? UnitKind::Number : UnitKind::Name;
    while (at_ < end && isWordCharacter(source_[at_])) ++at_;
  }
  return {kind, begin, at_};
}

Unit Scanner::nextCode() {
  Unit unit = next();
  while (unit.kind == UnitKind::Comment || unit.kind == UnitKind::Pragma) unit = next();
  return unit;
}

std::string firstWord(std::string_view source) {
  Scanner scanner(withoutMark(source));
  const Unit unit = scanner.nextCode();
  return unit.kind == UnitKind::Name ? upper(scanner.textOf(unit)) : std::string();
}

bool startsDeclaration(std::string_view text) {
  const std::string word = firstWord(text);
  for (const std::string_view known :
       {"PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "TYPE", "INTERFACE", "CONFIGURATION", "VAR_GLOBAL", "NAMESPACE"})
    if (word == known) return true;
  return false;
}

std::string_view endWordOf(std::string_view word) {
  struct Row {
    std::string_view word, end;
  };
  static constexpr Row kRows[] = {{"FUNCTION", "END_FUNCTION"},   {"FUNCTION_BLOCK", "END_FUNCTION_BLOCK"},
                                  {"PROGRAM", "END_PROGRAM"},     {"METHOD", "END_METHOD"},
                                  {"INTERFACE", "END_INTERFACE"}, {"ACTION", "END_ACTION"}};
  for (const Row& row : kRows)
    if (sameIdentifier(word, row.word)) return row.end;
  return {};
}

bool hasPragma(std::string_view text, std::initializer_list<std::string_view> words) {
  for (size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
    size_t begin = at + 1;
    while (begin < text.size() && isBlankCharacter(text[begin])) ++begin;
    size_t end = begin;
    while (end < text.size() && isNameCharacter(text[end])) ++end;
    for (const std::string_view word : words)
      if (sameIdentifier(text.substr(begin, end - begin), word)) return true;
  }
  return false;
}

bool isBlankCharacter(char c) { return static_cast<unsigned char>(c) <= ' '; }

bool isNameCharacter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || isDecimal(c) || c == '_'; }

bool isIdentifier(std::string_view s) {
  return !s.empty() && !isDecimal(s[0]) && std::all_of(s.begin(), s.end(), isNameCharacter);
}

bool isPath(std::string_view s) {
  for (;;) {
    const size_t dot = s.find('.');
    if (!isIdentifier(s.substr(0, dot))) return false;
    if (dot == std::string_view::npos) return true;
    s.remove_prefix(dot + 1);
  }
}

std::string_view withoutMark(std::string_view source) {
  return source.starts_with("\xef\xbb\xbf") ? source.substr(3) : source;
}

}  // namespace rung
