// SPDX-License-Identifier: Apache-2.0
#include "sema/code.h"

#include <gtest/gtest.h>

namespace rung::sema {
namespace {

class CodeTest : public testing::Test {
 protected:
  ExprId name(uint32_t offset) { return TreeBuilder(tree).name(NameId{1}, Loc{offset}); }
  ExprId sum() { return TreeBuilder(tree).binary(BinaryOp::Add, name(10), name(20), Loc{15}); }

  Tree tree;
  Code code{tree};
};

TEST_F(CodeTest, KnowsWhatWasWritten) {
  const ExprId written = sum();
  const ExprId copied = code.copy(written);
  const BinaryExpr& node = tree.as<BinaryExpr>(copied);
  EXPECT_EQ(meaning(tree, copied).written, written);
  EXPECT_EQ(meaning(tree, node.left).written, tree.as<BinaryExpr>(written).left);
  EXPECT_FALSE(typeOf(tree, copied));
}

TEST_F(CodeTest, ChangesNothingThatWasWritten) {
  const ExprId written = sum(), left = tree.as<BinaryExpr>(written).left;
  BinaryExpr& node = code.as<BinaryExpr>(code.copy(written));
  code.replace(node.left, code.build().literal(LiteralKind::Integer, 7, Loc{10}));
  EXPECT_EQ(tree.kind(node.left), ExprKind::Literal);
  EXPECT_EQ(meaning(tree, node.left).written, left);
  EXPECT_EQ(tree.as<BinaryExpr>(written).left, left);
  EXPECT_EQ(tree.kind(left), ExprKind::Name);
}

// A node that is in use elsewhere is duplicated: its own place is as it was.
TEST_F(CodeTest, ReplacesByADuplicate) {
  ExprId slot = code.copy(name(10));
  const ExprId written = meaning(tree, slot).written, other = code.copy(name(20));
  typeOf(tree, other) = TypeId{5};
  code.replace(slot, other);
  EXPECT_NE(slot, other);
  EXPECT_EQ(typeOf(tree, slot).index, 5u);
  EXPECT_EQ(meaning(tree, slot).written, written);
  EXPECT_NE(meaning(tree, other).written, written);
}

TEST_F(CodeTest, CopiesStatementsWithAllInThem) {
  TreeBuilder build(tree);
  const StmtId inner = build.assign(AssignOp::Assign, name(1), name(2), Loc{3});
  const StmtId outer = build.ifStatement(name(4), {&inner, 1}, Loc{5});
  const Slice<StmtId> copied = code.copy(tree.addList<StmtId>({&outer, 1}));
  const IfBranch& branch = tree.list(tree.as<IfStmt>(tree.list(copied)[0]).branches)[0];
  const StmtId statement = tree.list(branch.body)[0];
  EXPECT_NE(statement, inner);
  EXPECT_EQ(meaning(tree, tree.as<AssignStmt>(statement).value).written, tree.as<AssignStmt>(inner).value);
}

}  // namespace
}  // namespace rung::sema
