// SPDX-License-Identifier: Apache-2.0
// Storage of the tree: nodes and lists over chunk borders, strings, inserted nodes, and where an expression begins and
// ends.
#include "frontend/syntax/tree_builder.h"

#include <gtest/gtest.h>

#include <vector>

namespace rung {
namespace {

ExprId name(Tree& tree, uint32_t offset) { return TreeBuilder(tree).name(NameId{offset}, Loc{offset}); }

TEST(Tree, NodesStayAcrossChunks) {
  Tree tree;
  std::vector<ExprId> ids;
  for (uint32_t i = 1; i <= 100000; ++i) ids.push_back(name(tree, i));
  const NameExpr* first = &tree.as<NameExpr>(ids[0]);
  for (uint32_t i = 1; i <= 100000; ++i) {
    ASSERT_EQ(tree.kind(ids[i - 1]), ExprKind::Name);
    ASSERT_EQ(tree.as<NameExpr>(ids[i - 1]).name.index, i);
  }
  EXPECT_EQ(first, &tree.as<NameExpr>(ids[0]));
}

TEST(Tree, ListsAndStrings) {
  Tree tree;
  const uint32_t numbers[] = {1, 2, 3};
  const Slice<uint32_t> a = tree.addList<uint32_t>(numbers);
  const Slice<uint32_t> b = tree.addList<uint32_t>({});
  EXPECT_EQ(tree.list(a).size(), 3u);
  EXPECT_EQ(tree.list(a)[2], 3u);
  EXPECT_TRUE(b.empty());
  EXPECT_EQ(tree.string(tree.addString("pump")), "pump");
  EXPECT_EQ(tree.string(tree.addString("")), "");
}

// A list is a span that stays where it is while others are added, even one that is larger than a chunk.
TEST(Tree, ListsStayWhileOthersAreAdded) {
  Tree tree;
  std::vector<Slice<uint32_t>> slices;
  std::vector<std::span<uint32_t>> spans;
  for (uint32_t count = 1; count <= 300; ++count) {
    slices.push_back(tree.addList<uint32_t>(std::vector<uint32_t>(count, count)));
    spans.push_back(tree.list(slices.back()));
  }
  const std::vector<uint32_t> large(200'000, 7);
  const std::span<uint32_t> whole = tree.list(tree.addList<uint32_t>(large));
  name(tree, 1);
  EXPECT_EQ(std::vector<uint32_t>(whole.begin(), whole.end()), large);
  for (uint32_t k = 0; k < slices.size(); ++k) {
    ASSERT_EQ(spans[k].data(), tree.list(slices[k]).data());
    ASSERT_EQ(std::vector<uint32_t>(spans[k].begin(), spans[k].end()), std::vector<uint32_t>(k + 1, k + 1));
  }
}

TEST(Tree, BeginIsTheLeftmostToken) {
  Tree tree;
  TreeBuilder build(tree);
  const ExprId sum = build.binary(BinaryOp::Add, name(tree, 10), name(tree, 20), Loc{15});
  EXPECT_EQ(tree.loc(sum).offset, 15u);
  EXPECT_EQ(tree.begin(sum).offset, 10u);
  EXPECT_EQ(tree.begin(build.unary(UnaryOp::Negate, sum, Loc{9})).offset, 9u);
}

TEST(Tree, ParenthesesBelongToTheRange) {
  Tree tree;
  TreeBuilder build(tree);
  const auto ended = [&](ExprId id, uint32_t end) {
    tree.expr(id).end = Loc{end};
    return id;
  };
  const ExprId left = ended(build.name(NameId{1}, Loc{11}), 12), right = ended(build.name(NameId{2}, Loc{15}), 16);
  tree.parenthesize(left, Loc{10}, Loc{13});
  const ExprId sum = ended(build.binary(BinaryOp::Add, left, right, Loc{14}), 16);
  EXPECT_EQ(tree.range(left), (Range{Loc{10}, Loc{13}}));
  EXPECT_EQ(tree.range(sum), (Range{Loc{10}, Loc{16}}));
  EXPECT_EQ(tree.begin(sum), Loc{11});
}

}  // namespace
}  // namespace rung
