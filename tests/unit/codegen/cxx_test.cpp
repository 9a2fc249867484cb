// SPDX-License-Identifier: Apache-2.0
// C++ as a value: parentheses where the grammar needs them or g++ warns without them, and the lines of statements.
#include <gtest/gtest.h>

#include "codegen/cxx/print.h"

namespace rung::codegen::cxx {
namespace {

struct Cxx : testing::Test {
  Ex both(Op op, Ex left, Ex right) { return tree.infix(op, left, right); }
  void perform(Statements& to, std::string_view text) { to.add(tree.stmt(StmtKind::Expression, tree.name(text))); }
  void begin(Statements& to, std::string_view text, uint32_t line) {
    Stmt* const made = tree.stmt(StmtKind::Expression, tree.name(text));
    made->begins = true;
    made->at = {tree.file("a.st"), line};
    to.add(made);
  }
  std::string printed(const Statements& list) {
    std::string out;
    print(out, tree, list);
    return out;
  }

  Tree tree;
  Ex a = tree.fixed("a"), b = tree.fixed("b"), c = tree.fixed("c");
};

TEST_F(Cxx, OperandsGetTheParenthesesThatTheyNeed) {
  const Ex sum = both(Op::Add, a, b);
  EXPECT_EQ(toString(both(Op::Multiply, sum, c)), "(a + b) * c");
  EXPECT_EQ(toString(both(Op::Add, sum, c)), "a + b + c");
  EXPECT_EQ(toString(both(Op::Subtract, c, sum)), "c - (a + b)");
  EXPECT_EQ(toString(both(Op::Divide, c, both(Op::Multiply, a, b))), "c / (a * b)");
  EXPECT_EQ(toString(tree.cast("int16_t", sum)), "(int16_t)(a + b)");
  EXPECT_EQ(toString(tree.cast("int16_t", tree.cast("int32_t", a))), "(int16_t)(int32_t)a");
  EXPECT_EQ(toString(tree.member(tree.prefix("*", a), "x")), "(*a).x");
  EXPECT_EQ(toString(tree.element(a, sum)), "a[a + b]");
  EXPECT_EQ(toString(tree.prefix("-", tree.prefix("-", a))), "-(-a)");
  EXPECT_EQ(toString(tree.prefix("-", tree.signedNumber(-5))), "-(-5)");
  EXPECT_EQ(toString(tree.choice(tree.choice(a, b, c), b, c)), "(a ? b : c) ? b : c");
  EXPECT_EQ(toString(tree.call("f", {both(Op::Comma, a, b), c})), "f((a, b), c)");
  EXPECT_EQ(toString(both(Op::Assign, a, tree.choice(a, b, c))), "a = a ? b : c");
}

TEST_F(Cxx, OperandsOfWhichCompilersWarnGetThemToo) {
  EXPECT_EQ(toString(both(Op::Or, both(Op::And, a, b), c)), "(a && b) || c");
  EXPECT_EQ(toString(both(Op::Or, a, both(Op::Or, b, c))), "a || b || c");
  EXPECT_EQ(toString(both(Op::BitOr, both(Op::BitAnd, a, b), c)), "(a & b) | c");
  EXPECT_EQ(toString(both(Op::BitAnd, both(Op::BitAnd, a, b), c)), "a & b & c");
  EXPECT_EQ(toString(both(Op::BitOr, tree.prefix("!", a), b)), "(!a) | b");
  EXPECT_EQ(toString(both(Op::Equal, tree.prefix("!", a), tree.prefix("!", b))), "(!a) == !b");
  EXPECT_EQ(toString(both(Op::Less, both(Op::Less, a, b), c)), "(a < b) < c");
  EXPECT_EQ(toString(both(Op::ShiftLeft, both(Op::Add, a, b), c)), "(a + b) << c");
  EXPECT_EQ(toString(both(Op::Mask, both(Op::ShiftRight, a, b), tree.number(1))), "a >> b & 1");
}

TEST_F(Cxx, SameIsWhatPrintsTheSame) {
  EXPECT_TRUE(same(both(Op::Add, a, tree.number(1)), both(Op::Add, tree.name("a"), tree.number(1))));
  EXPECT_FALSE(same(both(Op::Add, a, b), both(Op::Subtract, a, b)));
  EXPECT_FALSE(same(tree.call("f", {a}), tree.call("f", {a, b})));
}

TEST_F(Cxx, LinesFollowTheSource) {
  Statements list;
  begin(list, "a", 3);
  perform(list, "b");
  begin(list, "c", 3);
  begin(list, "d", 5);
  begin(list, "e", 40);
  EXPECT_EQ(printed(list), "\n#line 3 \"a.st\"\n  a; b; c;\n\n  d;\n#line 40\n  e;");
}

TEST_F(Cxx, BracesCloseWhereTheSourceHasRoom) {
  Statements list, inner;
  begin(inner, "a", 2);
  Stmt* const test = tree.stmt(StmtKind::If, b);
  test->begins = true;
  test->at = {tree.file("a.st"), 1};
  test->first = inner.first();
  list.add(test);
  begin(list, "c", 4);
  EXPECT_EQ(printed(list), "\n#line 1 \"a.st\"\n  if (b) {\n    a;\n  }\n  c;");
}

TEST_F(Cxx, ATreeIsUsedAgain) {
  for (int round = 0; round < 3; ++round) {
    tree.clear();
    std::vector<Ex> arguments;
    for (int i = 0; i < 4000; ++i) arguments.push_back(tree.infix(Op::Add, tree.name("x"), tree.number(1)));
    EXPECT_EQ(toString(tree.call("f", arguments)).size(), 3 + 4000u * 7 - 2);
  }
}

}  // namespace
}  // namespace rung::codegen::cxx
