// Statements as Structured Text: what `rung convert --to st` writes for bodies that a scheduler made, before sema
// changes them. In: the tree as parsers and schedulers leave it. Out: text that parses to the same tree.
#pragma once

#include <span>
#include <string>

#include "frontend/syntax/tree.h"

namespace rung {

// A comment of the source, delimiters included. It goes in front of the first statement at or behind its place.
struct StComment {
  Loc at;
  std::string_view text;
};

// A line per statement, each indented by `indent` blanks and ended by a line break.
std::string printSt(const Tree& tree, const Names& names, Slice<StmtId> statements, uint32_t indent,
                    std::span<const StComment> comments);
// One expression or initial value.
std::string printSt(const Tree& tree, const Names& names, ExprId expr);

}  // namespace rung
