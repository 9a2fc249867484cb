// SPDX-License-Identifier: Apache-2.0
// C++ as a value: parentheses where the grammar needs them or g++ warns without them, the lines of statements, and
// declarations.
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
  template <class List>
  std::string printed(const List& list) {
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

TEST_F(Cxx, TheNameIsInsideItsType) {
  const std::vector<uint64_t> extents = {3, 81};
  EXPECT_EQ(toString(Type{"float", {}, {}}, "x"), "float x");
  EXPECT_EQ(toString(Type{"char", {}, extents}, "x"), "char x[3][81]");
  EXPECT_EQ(toString(Type{"struct Ramp_type", "*", {}}, "x"), "struct Ramp_type* x");
  EXPECT_EQ(toString(Type{"char", "*", extents}, "x"), "char (*x)[3][81]");
  const std::vector<uint64_t> unknown = {0};
  EXPECT_EQ(toString(Type{"f_call* const", {}, unknown}, "table"), "f_call* const table[]");
}

TEST_F(Cxx, VariablesHaveValuesOrArguments) {
  Declarations list;
  Variable* const first = tree.variable("int", "x", tree.number(0));
  first->also = tree.variable("int", "y");
  list.add(first);
  Variable* const second = tree.variable("Motor", "m");
  second->prefix = "const";
  second->arguments = tree.call("", {a, b});
  list.add(second);
  EXPECT_EQ(printed(list), "int x = 0, y;\nconst Motor m(a, b);\n");
}

TEST_F(Cxx, AFunctionIsAPrototypeOrHasABody) {
  Declarations list;
  const auto function = [&](Function::Form form) {
    Function* const made = tree.declaration<Function>();
    made->result.base = "int";
    made->name = "f";
    made->parameters.add(tree.variable(Type{"char", "*", {}}, "x"));
    made->parameters.add(tree.variable("int", "y"));
    made->form = form;
    list.add(made);
    return made;
  };
  function(Function::Form::Prototype)->prefix = "extern";
  Statements body, exits;
  body.add(tree.declare(tree.variable("int", "z")));
  body.first()->begins = true;
  perform(body, "g()");
  exits.add(tree.textual(StmtKind::Exit, "leave"));
  exits.add(tree.stmt(StmtKind::Return, a));
  Function* const lines = function(Function::Form::Lines);
  lines->body = body.first();
  lines->exits = exits.first();
  function(Function::Form::OneLine)->body = body.first();
  function(Function::Form::OneLine)->suffix = " const";
  EXPECT_EQ(printed(list),
            "extern int f(char* x, int y);\nint f(char* x, int y) {\n  int z; g();\nleave: return a;\n}\n"
            "int f(char* x, int y) {\n  int z; g(); }\nint f(char* x, int y) const {}\n");
}

TEST_F(Cxx, RecordsInANamespace) {
  Declarations list;
  Namespace* const space = tree.declaration<Namespace>();
  space->name = "plc";
  Record* const outer = tree.declaration<Record>();
  outer->keyword = "struct";
  outer->name = "R";
  outer->members.add(tree.variable("int", "x"));
  Record* const inner = tree.declaration<Record>();
  inner->keyword = "struct";
  inner->is_line = true;
  inner->members.add(tree.variable("int", "y"));
  outer->members.add(inner);
  space->members.add(outer);
  const std::vector<Enumeration::Item> items = {{"Red", tree.number(1)}, {"Blue", tree.number(2)}};
  for (const bool is_line : {true, false}) {
    Enumeration* const colors = tree.declaration<Enumeration>();
    colors->name = "Color";
    colors->base = "int8_t";
    colors->items = items;
    colors->is_line = is_line;
    space->members.add(colors);
  }
  list.add(tree.textual(DeclKind::Include, "x.h"));
  list.add(space);
  EXPECT_EQ(printed(list),
            "#include \"x.h\"\nnamespace plc {\nstruct R {\n  int x;\n  struct { int y; };\n};\n"
            "enum Color : int8_t { Red = 1, Blue = 2 };\nenum Color : int8_t {\n  Red = 1,\n  Blue = 2,\n};\n"
            "\n}  // namespace plc\n");
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
