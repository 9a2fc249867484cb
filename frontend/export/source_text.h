// SPDX-License-Identifier: Apache-2.0
// The source of a file as the export quotes it, with lookup of comments and words. In: a parsed file. Out: offsets in
// it, and the content of its comments. One pass on construction; each lookup is a binary search and a short walk.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/source/scanner.h"

namespace rung::exporter {

class SourceText {
 public:
  SourceText(const Sources& sources, FileId file);

  size_t at(Loc loc) const { return loc.offset - base_; }
  std::string_view cut(size_t begin, size_t end) const { return source_.substr(begin, end - begin); }

  // The start of the comments directly before `p`; `p` if there are none. A comment that follows code on the same line
  // belongs to that code, and counts only for `all`.
  size_t commentsBefore(size_t p, bool all = false) const;
  // The end of the comments after `p` on its line.
  size_t commentsAfter(size_t p) const;
  // The end of the comments between `p` and an END_…; `p` if there are none.
  size_t endWithComments(size_t p) const;
  // The content of the comments in [begin, end), line by line.
  std::string comments(size_t begin, size_t end) const;
  // The range of each of these comments.
  struct Span {
    size_t begin, end;
  };
  std::vector<Span> commentsIn(size_t begin, size_t end) const;

  // The end of the first such word after `p`; the end of the source if there is none.
  size_t endOfWord(size_t p, std::string_view word) const;
  // The start of the last such word before `p`; `p` if there is none.
  size_t wordBefore(size_t p, std::string_view word) const;
  // Tells whether the first unit at or after `p` is `word`, or begins with it.
  bool wordFollows(size_t p, std::string_view word) const;
  // The offset after the `;` of the variable or type whose name is at `p`.
  size_t endOfDeclaration(size_t p) const;
  // The end of the pragma that begins at `p`.
  size_t endOfPragma(size_t p) const;
  // The inside of the parentheses around `p`, at the nesting depth of `from`; an empty span: none.
  Span parenthesesAround(size_t from, size_t p) const;

 private:
  size_t unitAt(size_t p) const;  // the first that begins at or after `p`
  std::string_view textOf(const Unit& unit) const { return cut(unit.begin, unit.end); }
  bool lineEnds(size_t begin, size_t end) const { return cut(begin, end).find('\n') != std::string_view::npos; }

  std::string_view source_;
  uint32_t base_;
  std::vector<Unit> units_;
};

}  // namespace rung::exporter
