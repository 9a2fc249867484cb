// Storage of the tree: nodes over chunk borders, lists, strings, and where an expression begins.
#include "frontend/syntax/tree.h"

#include <gtest/gtest.h>

#include <vector>

namespace rung {
namespace {

ExprId name(Tree& tree, uint32_t offset) {
  return tree.add<ExprId>(NameExpr{{ExprKind::Name, 0, 0, 0, 0, 0, {offset}, {}}, {offset}, {}});
}

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
}

TEST(Tree, BeginIsTheLeftmostToken) {
  Tree tree;
  const ExprId a = name(tree, 10), b = name(tree, 20);
  const ExprId sum =
      tree.add<ExprId>(BinaryExpr{{ExprKind::Binary, 0, 0, 0, static_cast<uint8_t>(BinaryOp::Add), 0, {15}, {}}, a, b});
  EXPECT_EQ(tree.loc(sum).offset, 15u);
  EXPECT_EQ(tree.begin(sum).offset, 10u);
  const ExprId negated =
      tree.add<ExprId>(UnaryExpr{{ExprKind::Unary, 0, 0, 0, static_cast<uint8_t>(UnaryOp::Negate), 0, {9}, {}}, sum});
  EXPECT_EQ(tree.begin(negated).offset, 9u);
}

}  // namespace
}  // namespace rung
