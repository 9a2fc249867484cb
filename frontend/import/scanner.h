// Finds words of ST outside of comments, strings and pragmas, without parsing. Used by the readers of this folder to
// find where a POU begins and ends.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rung::vendor {

// Iterates over the words of a source.
class Scanner {
 public:
  explicit Scanner(std::string_view source) : source_(source) {}

  // The next word; false at the end. Numbers and operators are skipped.
  bool next();
  std::string_view word() const { return source_.substr(begin_, p_ - begin_); }
  size_t begin() const { return begin_; }  // of the word
  size_t end() const { return p_; }
  bool atLineStart() const { return first_on_line_ == begin_ + 1; }  // only blanks and comments before it on its line
  // Whether anything but blanks, comments and pragmas was skipped since the last word.
  bool skippedOther() const { return skipped_other_; }
  void moveTo(size_t at) { p_ = at; }

 private:
  std::string_view source_;
  size_t begin_ = 0, p_ = 0;
  size_t first_on_line_ = 0;  // one past the start of the last word that began a line
  bool line_start_ = true;
  bool skipped_other_ = false;
  bool nests_ = true;  // false after (* @NESTEDCOMMENTS := 'No' *) of CODESYS 2.3
};

// The offset after the comment that begins at `at`; the end of the source if it is not closed.
size_t endOfComment(std::string_view source, size_t at, bool nests = true);

std::string upper(std::string_view source);

// END_FUNCTION for FUNCTION; empty for words that do not begin a POU.
std::string_view endWordOf(std::string_view word);

}  // namespace rung::vendor
