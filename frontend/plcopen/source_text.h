// The text of a file as the export quotes it: where its comments and words are. In: what was parsed. Out: places in it,
// as offsets, and the words of its comments. One pass when made; questions are a binary search and a short walk.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/files.h"

namespace rung::plcopen {

class SourceText {
 public:
  SourceText(const Sources& sources, FileId file);

  size_t at(Loc loc) const { return loc.offset - base_; }
  std::string_view cut(size_t begin, size_t end) const { return source_.substr(begin, end - begin); }

  // Where the comments begin that stand before `p` with only blanks between; `p` where none do. Those behind something
  // on its line belong to that, and count only for `all`.
  size_t commentsBefore(size_t p, bool all = false) const;
  // Where the comments end that stand behind `p` on its line.
  size_t commentsAfter(size_t p) const;
  // Where the comments end that stand behind `p` and before an END_…; `p` where there are none.
  size_t endWithComments(size_t p) const;
  // The words of the comments in [begin, end), line by line.
  std::string comments(size_t begin, size_t end) const;
  // Where each of these comments stands.
  struct Span {
    size_t begin, end;
  };
  std::vector<Span> commentsIn(size_t begin, size_t end) const;

  // The end of the first such word behind `p`; the end of the text where there is none.
  size_t endOfWord(size_t p, std::string_view word) const;
  // Where the last such word before `p` begins; `p` where there is none.
  size_t wordBefore(size_t p, std::string_view word) const;
  // What stands at or behind `p` is `word`, or begins with it.
  bool wordFollows(size_t p, std::string_view word) const;
  // Behind the `;` of the variable or type whose name stands at `p`.
  size_t endOfDeclaration(size_t p) const;
  // The pragma that begins at `p`.
  size_t endOfPragma(size_t p) const;
  // Between the parentheses that hold `p` and stand no deeper than `from`; an empty span: none do.
  Span parenthesesAround(size_t from, size_t p) const;

 private:
  enum class Kind : uint8_t { Comment, Pragma, Text, Word, Punctuation };
  struct Unit {
    uint32_t begin, end;
    Kind kind;
  };
  size_t unitAt(size_t p) const;  // the first that begins at or behind `p`
  std::string_view textOf(const Unit& unit) const { return cut(unit.begin, unit.end); }
  bool lineEnds(size_t begin, size_t end) const { return cut(begin, end).find('\n') != std::string_view::npos; }

  std::string_view source_;
  uint32_t base_;
  std::vector<Unit> units_;
};

}  // namespace rung::plcopen
