// Reading ST text without parsing it: words outside of comments, strings and pragmas. Used by the readers of this
// folder, which must know where a POU begins and ends.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rung::vendor {

// Walks over the words of a text.
class Scanner {
 public:
  explicit Scanner(std::string_view source) : source_(source) {}

  // The next word; false at the end. Numbers and operators are passed over.
  bool next();
  std::string_view word() const { return source_.substr(begin_, p_ - begin_); }
  size_t begin() const { return begin_; }  // of the word
  size_t end() const { return p_; }
  bool atLineStart() const { return first_on_line_ == begin_ + 1; }  // only blanks and comments before it on its line
  // Passed over since the last word: something that is neither blank, comment nor pragma.
  bool skippedOther() const { return skipped_other_; }
  void moveTo(size_t at) { p_ = at; }

 private:
  std::string_view source_;
  size_t begin_ = 0, p_ = 0;
  size_t first_on_line_ = 0;  // one past the begin of the last word that began a line
  bool line_start_ = true;
  bool skipped_other_ = false;
  bool nests_ = true;  // (* @NESTEDCOMMENTS := 'No' *) of CODESYS 2.3 was not passed
};

// One past the comment that begins at `at`; the end of the text where it is not closed.
size_t endOfComment(std::string_view source, size_t at, bool nests = true);

std::string upper(std::string_view source);

// END_FUNCTION for FUNCTION; empty for what is no POU.
std::string_view endWordOf(std::string_view word);

}  // namespace rung::vendor
