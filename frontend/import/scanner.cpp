// Words of ST; see scanner.h.
#include "frontend/import/scanner.h"

#include <algorithm>

#include "frontend/source/names.h"
#include "frontend/source/nested_comments.h"

namespace rung::vendor {
namespace {

bool isWordChar(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

// Strings in a pragma may contain braces.
size_t endOfPragma(std::string_view source, size_t at) {
  for (size_t i = at + 1; i < source.size(); ++i) {
    if (source[i] == '}') return i + 1;
    if (source[i] != '\'' && source[i] != '"') continue;
    const size_t close = source.find_first_of(source[i] == '"' ? "\"\n" : "'\n", i + 1);
    if (close != std::string_view::npos && source[close] == source[i]) i = close;
  }
  return source.size();
}

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

bool Scanner::next() {
  const size_t end = source_.size();
  skipped_other_ = false;
  while (p_ < end) {
    const char c = source_[p_], after = p_ + 1 < end ? source_[p_ + 1] : '\0';
    if (c == '\n' || c == '\r') {
      line_start_ = true;
      ++p_;
    } else if (c == ' ' || c == '\t' || c == '\f' || c == '\v') {
      ++p_;
    } else if (c == '/' && after == '/') {
      p_ = std::min(source_.find('\n', p_), end);
    } else if ((c == '(' || c == '/') && after == '*') {
      const size_t begin = p_;
      p_ = std::min(endOfComment(source_, p_, nests_), end);
      if (const char* const nesting = nestingOf(source_.substr(begin, p_ - begin))) nests_ = *nesting == 'Y';
    } else if (c == '{') {
      p_ = std::min(endOfPragma(source_, p_), end);
    } else if (c == '\'' || c == '"') {
      skipped_other_ = true;
      size_t i = p_ + 1;
      while (i < end && source_[i] != c && source_[i] != '\n') i += source_[i] == '$' ? 2 : 1;
      p_ = std::min(i < end && source_[i] == c ? i + 1 : i, end);
      line_start_ = false;
    } else if (isWordChar(c)) {
      begin_ = p_;
      while (p_ < end && isWordChar(source_[p_])) ++p_;
      const bool number = c >= '0' && c <= '9';
      if (!number) {
        if (line_start_) first_on_line_ = begin_ + 1;
        line_start_ = false;
        return true;
      }
      skipped_other_ = true;
      line_start_ = false;
    } else {
      skipped_other_ = true;
      line_start_ = false;
      ++p_;
    }
  }
  begin_ = p_;
  return false;
}

std::string upper(std::string_view source) {
  std::string out(source);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return out;
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

}  // namespace rung::vendor
