// Words of ST text; see words.h.
#include "frontend/vendor/words.h"

#include <algorithm>

#include "frontend/source/names.h"
#include "frontend/source/nested_comments.h"

namespace rung::vendor {
namespace {

bool isWordChar(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

// Strings in a pragma may hold braces.
size_t endOfPragma(std::string_view text, size_t at) {
  for (size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == '}') return i + 1;
    if (text[i] != '\'' && text[i] != '"') continue;
    const size_t close = text.find_first_of(text[i] == '"' ? "\"\n" : "'\n", i + 1);
    if (close != std::string_view::npos && text[close] == text[i]) i = close;
  }
  return text.size();
}

}  // namespace

size_t endOfComment(std::string_view text, size_t at, bool nests) {
  const char open = text[at], close = open == '(' ? ')' : '/';
  uint32_t depth = 0;
  for (size_t i = at; i + 1 < text.size(); ++i) {
    if (text[i] == open && text[i + 1] == '*' && (nests || depth == 0)) {
      ++depth;
      ++i;
    } else if (text[i] == '*' && text[i + 1] == close) {
      ++i;
      if (--depth == 0) return i + 1;
    }
  }
  return text.size();
}

bool Words::next() {
  const size_t end = text_.size();
  passed_other_ = false;
  while (p_ < end) {
    const char c = text_[p_], after = p_ + 1 < end ? text_[p_ + 1] : '\0';
    if (c == '\n' || c == '\r') {
      line_start_ = true;
      ++p_;
    } else if (c == ' ' || c == '\t' || c == '\f' || c == '\v') {
      ++p_;
    } else if (c == '/' && after == '/') {
      p_ = std::min(text_.find('\n', p_), end);
    } else if ((c == '(' || c == '/') && after == '*') {
      const size_t begin = p_;
      p_ = std::min(endOfComment(text_, p_, nests_), end);
      if (const char* const said = nestingOf(text_.substr(begin, p_ - begin))) nests_ = *said == 'Y';
    } else if (c == '{') {
      p_ = std::min(endOfPragma(text_, p_), end);
    } else if (c == '\'' || c == '"') {
      passed_other_ = true;
      size_t i = p_ + 1;
      while (i < end && text_[i] != c && text_[i] != '\n') i += text_[i] == '$' ? 2 : 1;
      p_ = std::min(i < end && text_[i] == c ? i + 1 : i, end);
      line_start_ = false;
    } else if (isWordChar(c)) {
      begin_ = p_;
      while (p_ < end && isWordChar(text_[p_])) ++p_;
      const bool number = c >= '0' && c <= '9';
      if (!number) {
        if (line_start_) first_on_line_ = begin_ + 1;
        line_start_ = false;
        return true;
      }
      passed_other_ = true;
      line_start_ = false;
    } else {
      passed_other_ = true;
      line_start_ = false;
      ++p_;
    }
  }
  begin_ = p_;
  return false;
}

std::string upper(std::string_view text) {
  std::string out(text);
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
