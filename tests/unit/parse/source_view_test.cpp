// SPDX-License-Identifier: Apache-2.0
// The source as the tree divides it, and the file printed back.
#include "frontend/syntax/source_view.h"

#include <gtest/gtest.h>

#include <string>

#include "frontend/source/scanner.h"
#include "tests/unit/parse/parsed_file.h"

namespace rung {
namespace {

// The pieces make up the file, and no token is in two of them.
void checkPieces(const ParsedFile& f, const std::string& path) {
  ASSERT_EQ(printSource(f.tree, f.unit, f.sources), f.sources.original(f.file)) << path;
  for (const char* rare : {"string_over_lines.st", "string_not_closed.st"})  // a unit of Scanner ends with its line
    if (path.ends_with(rare)) return;
  Scanner scanner(f.sources.sourceText(f.file));
  Unit token = scanner.next();
  for (const SourcePiece& piece : piecesOf(f.tree, f.unit, f.sources)) {
    const size_t end = piece.range.end.offset - f.begin();
    while (token.kind != UnitKind::End && token.begin < end) {
      EXPECT_LE(token.end, end) << path << ": `" << scanner.textOf(token) << "`";
      token = scanner.next();
    }
  }
}

std::string show(const ParsedFile& f, NodeRef node) {
  std::string out;
  for (const Range token : tokensOf(f.tree, f.sources, node)) out += "[" + std::string(f.textOf(token)) + "]";
  return out;
}

TEST(SourceView, TokensOfANodeItself) {
  const ParsedFile f("PROGRAM p IF a (* why *) THEN b := 1; ELSE c(); END_IF; END_PROGRAM");
  const std::vector<NodeRef> nodes = f.at(10);
  ASSERT_EQ(nodes.size(), 2u);
  EXPECT_EQ(show(f, nodes[1]), "[IF][(* why *)][THEN][ELSE][END_IF][;]");
  EXPECT_EQ(show(f, nodes[0]), "[PROGRAM][p][END_PROGRAM]");
}

TEST(SourceView, EveryProgram) { EXPECT_GT(forEachProgram({"/tests", "/samples", "/stdlib"}, checkPieces), 1000u); }

// Files that stop anywhere, or lack a piece.
TEST(SourceView, BrokenPrograms) {
  forEachProgram({"/samples", "/tests/conformance/language"}, [](const ParsedFile& f, const std::string& path) {
    forEachMutant(f, [&](const ParsedFile& mutant) {
      EXPECT_EQ(printSource(mutant.tree, mutant.unit, mutant.sources), mutant.sources.original(mutant.file)) << path;
    });
  });
}

}  // namespace
}  // namespace rung
