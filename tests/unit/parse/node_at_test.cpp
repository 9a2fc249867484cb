// SPDX-License-Identifier: Apache-2.0
// The node at a byte of a file, and the nodes around it.
#include "frontend/syntax/node_at.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "frontend/syntax/children.h"
#include "tests/unit/parse/parsed_file.h"

namespace rung {
namespace {

bool holds(Range outer, Range inner) { return outer.begin <= inner.begin && inner.end <= outer.end; }

// Every 50th byte of a file.
void checkNodes(const ParsedFile& f, const std::string& path) {
  for (uint32_t offset = 0; offset < f.size(); offset += 50) {
    const Loc loc{f.begin() + offset};
    const std::vector<NodeRef> nodes = f.at(offset);
    Range outer{{f.begin()}, {f.begin() + f.size()}};
    for (const NodeRef node : nodes) {
      const Range range = extentOf(f.tree, node);
      const auto where = [&] { return path + ": `" + std::string(f.textOf(range)) + "`"; };
      const bool in_halves = node.category == NodeRef::Category::Decl &&
                             f.tree.kind(DeclId{node.word}) == DeclKind::Property &&
                             f.tree.as<PropertyDecl>(DeclId{node.word}).in_halves;
      if (in_halves) continue;  // its second half is elsewhere
      EXPECT_TRUE(range.begin <= loc && loc < range.end) << where();
      EXPECT_TRUE(holds(outer, range)) << where() << " within `" << f.textOf(outer) << "`";
      outer = range;
    }
    if (nodes.empty()) continue;
    withId(nodes.back(), [&](auto id) {
      forEachChild(f.tree, id, [&](auto child) {
        const Range range = f.tree.range(child);
        EXPECT_FALSE(range.begin <= loc && loc < range.end) << path << ": `" << f.textOf(range) << "`";
      });
    });
  }
}

TEST(NodeAt, InnermostNodeAndThoseAround) {
  const ParsedFile f("PROGRAM p VAR a, b : INT; END_VAR\nIF a > 3 THEN b := a + (7 * b); END_IF\nEND_PROGRAM\n");
  EXPECT_EQ(f.pathTo("7"),
            "[7][(7 * b)][a + (7 * b)][b := a + (7 * b);][IF a > 3 THEN b := a + (7 * b); END_IF]"
            "[PROGRAM p VAR a, b : INT; END_VAR\nIF a > 3 THEN b := a + (7 * b); END_IF\nEND_PROGRAM]");
  EXPECT_EQ(f.pathTo("INT").substr(0, 43), "[INT][a, b : INT;][VAR a, b : INT; END_VAR]");
  EXPECT_EQ(f.at(f.size() - 1).size(), 0u);
}

TEST(NodeAt, StatementsOfChainsOverlap) {
  const ParsedFile f("PROGRAM p VAR a, b, c : INT; END_VAR a := b := c; b := 1; END_PROGRAM");
  EXPECT_EQ(f.pathTo("a := b").substr(0, 20), "[a][a := b := c;][PR");
  EXPECT_EQ(f.pathTo("b := c").substr(0, 15), "[b][b := c;][PR");
}

TEST(NodeAt, MembersAfterTheirBlock) {
  const ParsedFile f("FUNCTION_BLOCK f END_FUNCTION_BLOCK METHOD m x := 1; END_METHOD");
  EXPECT_EQ(f.pathTo("x :=").substr(0, 47), "[x][x := 1;][METHOD m x := 1; END_METHOD][FUNCT");
}

TEST(NodeAt, ConditionOfANamedTransition) {
  const ParsedFile f(
      "PROGRAM p INITIAL_STEP a: END_STEP TRANSITION t FROM a TO a; END_TRANSITION\n"
      "TRANSITION t := x AND y; END_TRANSITION END_PROGRAM");
  EXPECT_EQ(f.pathTo("y; END").substr(0, 13), "[y][x AND y][");
}

TEST(NodeAt, ErrorsHoldWhatWasSkipped) {
  const ParsedFile f("PROGRAM p VAR a : INT; b : ARRAY OF OF 7; END_VAR a := 1 + ) b c; END_PROGRAM");
  EXPECT_EQ(f.pathTo(") b").substr(0, 31), "[) b c][1 + ) b c][a := 1 + ) b");
}

TEST(NodeAt, EveryProgram) {
  EXPECT_GT(
      forEachProgram({"/tests/conformance", "/tests/programs", "/tests/golden", "/samples", "/stdlib"}, checkNodes),
      900u);
}

// A block of 20 000 statements: far less than a walk over them.
TEST(NodeAt, LongFiles) {
  std::string source = "PROGRAM p\n";
  for (int i = 0; i < 20000; ++i) source += "x := x + 1;\n";
  const ParsedFile f(source + "END_PROGRAM\n");
  const auto begin = std::chrono::steady_clock::now();
  size_t depth = 0;
  for (uint32_t i = 0; i < 1000; ++i) depth += f.at(10 + 240 * i + 5).size();
  EXPECT_EQ(depth, 4000u);  // the POU, the statement, the sum, `x`
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(200));
}

// Files that stop anywhere, or lack a piece.
TEST(NodeAt, BrokenPrograms) {
  forEachProgram({"/samples", "/tests/conformance/language"}, [](const ParsedFile& f, const std::string& path) {
    forEachMutant(f, [&](const ParsedFile& mutant) { checkNodes(mutant, path); });
  });
}

}  // namespace
}  // namespace rung
