// SPDX-License-Identifier: Apache-2.0
// The comments of parsed files, kept beside the tree for a formatter or an editor. In: the comments that the lexer saw,
// when it is asked to keep them (text::parseFile). Out: those at a node, found by its range (Tree::range).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/syntax/tree.h"

namespace rung {

enum class CommentKind : uint8_t {
  Line,   // // …
  Block,  // (* … *)  /* … */
  Doc,    // /// …
};
struct Comment {
  Range range;  // without the line end
  CommentKind kind;
};

class Trivia {
 public:
  // The comments of one file or part of it, in source order.
  void add(std::span<const Comment> comments);

  std::span<const Comment> all() const { return comments_; }  // sorted
  std::span<const Comment> within(Range range) const;
  // The comments before a node that begins at `node`, with nothing but white space between them and it; without one
  // that follows a token on its own line.
  std::span<const Comment> before(const Sources& sources, Loc node) const;
  // The comments after a node that ends at `node`, on the same line, directly or after a `;` or `,`.
  std::span<const Comment> after(const Sources& sources, Loc node) const;

 private:
  std::span<const Comment> slice(size_t first, size_t last) const {
    return std::span<const Comment>(comments_).subspan(first, last - first);
  }
  size_t firstOnLine(const Sources& sources, size_t comment) const;  // of comments that follow each other on one line
  size_t firstFrom(Loc loc) const;  // index of the first comment that begins at `loc` or later

  std::vector<Comment> comments_;
};

}  // namespace rung
