// SPDX-License-Identifier: Apache-2.0
// Statements as Structured Text: the output of `rung convert --to st` for bodies that a scheduler made, before they
// are checked. In: the tree as parsers and schedulers create it. Out: source that parses to the same tree.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/syntax/tree.h"

namespace rung {

// A comment of the source, delimiters included. It is printed before the first statement that begins at or after its
// location.
struct StComment {
  Loc at;
  std::string_view text;
};

// A line per statement, each indented by `indent` spaces and ended by a line break.
std::string printSt(const Tree& tree, const Names& names, Slice<StmtId> statements, uint32_t indent,
                    std::span<const StComment> comments);
// One expression or initial value.
std::string printSt(const Tree& tree, const Names& names, ExprId expr);
// `name : type := value;` of a variable that a scheduler declares.
std::string printSt(const Tree& tree, const Names& names, const VarDecl& variable);

// The statements of a chart. What the chart quotes is printed as it is in the source, and in parentheses where the
// scheduler says so.
struct ChartText {
  struct Line {  // a line that begins with a statement or continues what is quoted
    Loc origin;
    size_t begin;
  };
  std::string text;
  std::vector<Line> lines;
};
// `members`: the steps and actions, by whose locations the labels of the scheduler's CASE statements get their names.
ChartText printChart(const Tree& tree, const Names& names, const Sources& sources, Slice<StmtId> statements,
                     std::span<const Ident> members);

}  // namespace rung
