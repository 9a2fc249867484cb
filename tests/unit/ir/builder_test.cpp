// SPDX-License-Identifier: Apache-2.0
// The constructors of IR nodes and the walks.
#include "ir/builder.h"

#include <gtest/gtest.h>

#include "ir/verify.h"
#include "ir/walk.h"
#include "ir_text.h"

namespace rung::ir {
namespace {

struct BuilderTest : testing::Test {
  BuilderTest() : types(names, 8), module(types, names, sources), body(module.bodies.emplace_back()), b(module, body) {
    body.name = body.spelling = names.intern("f");
  }
  Names names;
  Sources sources;
  types::TypeTable types;
  Module module;
  Body& body;
  Builder b;
};

TEST_F(BuilderTest, BuildsWhatTheTextShows) {
  const uint32_t x = b.local(names.intern("x"), types::kInt, LocalKind::Input);
  const uint32_t t = b.temp(types::kInt);
  b.open();
  Block outer = b.open();
  b.assign(b.localPlace(t), b.binary(Op::Add, b.localPlace(x), b.integer(types::kInt, 1)));
  StmtId then_block = b.close(outer);
  b.ifElse(b.binary(Op::Lt, b.localPlace(x), b.integer(types::kInt, 10)), then_block);
  b.returnBody();
  body.first = b.block().first;
  EXPECT_EQ(squeeze(print(module, body)),
            "function @f { in x: int } body @f { temp t1: int if lt int x, 10 { %t1 = add int x, 1 } return }");
  EXPECT_TRUE(verify(module).empty());
}

TEST_F(BuilderTest, CopyIsATreeOfItsOwn) {
  const uint32_t a =
      b.local(names.intern("a"), types.array(types::kInt, std::vector<types::Dimension>{{0, 9}}), LocalKind::Variable);
  const uint32_t i = b.local(names.intern("i"), types::kInt, LocalKind::Variable);
  ExprId place = b.index(b.localPlace(a), b.binary(Op::Sub, b.localPlace(i), b.integer(types::kInt, 1)), kCheckIndex);
  b.open();
  b.assign(place, b.copy(place));
  body.first = b.block().first;
  EXPECT_EQ(verify(module), std::vector<std::string>{"[29] body `f`: the body may fault, but is not may_fault"});
  EXPECT_NE(squeeze(print(module, body)).find("a[sub int i, 1]! = a[sub int i, 1]!"), std::string::npos);
}

TEST_F(BuilderTest, AnExpressionIsAnOperandOnce) {
  const uint32_t x = b.local(names.intern("x"), types::kInt, LocalKind::Variable);
  const ExprId read = b.localPlace(x);
  const ExprId doubled = b.binary(Op::Add, read, b.copy(read));
  EXPECT_NE(body.expr(doubled).as<BinaryExpr>().left, body.expr(doubled).as<BinaryExpr>().right);
  EXPECT_EXIT(b.unary(Op::Neg, read), testing::ExitedWithCode(70), "a second one takes a copy");
  EXPECT_EXIT(b.list(std::vector<ExprId>{doubled, doubled}), testing::ExitedWithCode(70), "a second one takes a copy");
  b.detach(read);
  EXPECT_EQ(body.expr(b.unary(Op::Neg, read)).as<UnaryExpr>().operand, read);
}

TEST_F(BuilderTest, SetGivesANodeAnotherKindInPlace) {
  const uint32_t x = b.local(names.intern("x"), types::kInt, LocalKind::Variable);
  const ExprId node = b.integer(types::kInt, -5);
  EXPECT_EQ(static_cast<int64_t>(bitsOf(body.expr(node))), -5);
  EXPECT_EQ(body.expr(node).tryAs<LocalExpr>(), nullptr);
  body.expr(node).set(LocalExpr{.local = x});
  EXPECT_EQ(*localOf(body.expr(node)), x);
  EXPECT_EQ(body.expr(node).tryAs<ConstExpr>(), nullptr);
  EXPECT_EQ(body.expr(node).type, types::kInt);
}

TEST_F(BuilderTest, ParametersAreTheLocalsThatACallGives) {
  b.local(names.intern("v"), types::kInt, LocalKind::Variable);
  EXPECT_TRUE(parameters(body).empty());
  b.local(names.intern("i"), types::kInt, LocalKind::Input);
  b.temp(types::kInt);
  b.local(names.intern("o"), types::kInt, LocalKind::Output);
  b.local(names.intern("r"), types::kInt, LocalKind::Result);
  b.local(names.intern("io"), types::kInt, LocalKind::InOut);
  std::string seen;
  for (const Local& parameter : parameters(body)) seen += std::string(names.string(parameter.name)) + " ";
  EXPECT_EQ(seen, "i o io ");
  EXPECT_EQ(parameters(body).count(), 3u);
}

TEST_F(BuilderTest, NegationTakesADoubleOneAway) {
  const uint32_t x = b.local(names.intern("x"), types::kBool, LocalKind::Variable);
  ExprId once = b.negation(b.localPlace(x));
  EXPECT_EQ(body.expr(once).op(), Op::Not);
  EXPECT_EQ(body.expr(b.negation(once)).kind, ExprKind::Local);
}

TEST_F(BuilderTest, TempsOfASecondBuilderGoOn) {
  b.temp(types::kInt);
  Builder second(module, body);
  const uint32_t t = second.temp(types::kReal);
  EXPECT_EQ(names.string(body.locals[t].name), "t2");
}

TEST(Walk, VisitsOperandsBeforeNodesLeftToRight) {
  TestModule m("function @f { in x: int; in y: int; result int }\nbody @f { return add int (mul int x, 2), y }\n");
  ASSERT_TRUE(m.ok) << m.errors();
  Body& body = *m.find("f");
  std::string order;
  forEachStmt(body, body.first, [&](StmtId id) {
    forEachRoot(m.module, body, body.stmt(id), [&](ExprId root, Use use) {
      order += use == Use::Write ? "w" : "r";
      forEachExpr(body, root, [&](ExprId e) {
        order += body.expr(e).kind == ExprKind::Binary ? types::word(body.expr(e).op()) : ".";
      });
    });
  });
  EXPECT_EQ(order, "w.r..mul.add");
}

TEST(Walk, VisitsTheBlocksOfEachKindOfStatement) {
  TestModule m(
      "function @f { in x: int; result int }\n"
      "body @f {\n"
      "  switch x { case 1 { return 1 } case 2..3 { return 2 } else { return 3 } }\n"
      "  loop { break } next { return 4 }\n"
      "  try { return 5 } catch { return 6 } finally { return 7 }\n"
      "  if true { return 8 } else { return 9 }\n"
      "}\n");
  ASSERT_TRUE(m.ok) << m.errors();
  const Body& body = *m.find("f");
  std::string seen;
  forEachStmt(body, body.first, [&](StmtId id) {
    if (const auto* assign = body.stmt(id).tryAs<AssignStmt>())
      seen += std::to_string(bitsOf(body.expr(assign->value)));
  });
  EXPECT_EQ(seen, "123456789");
}

TEST(Walk, ACallReadsItsInputsAndReferencesTheRest) {
  TestModule m(
      "function @g { in a: int; out b: int; inout c: int; result int }\n"
      "body @g { return a }\n"
      "function @f { }\n"
      "body @f { var x: int var y: int var z: int z = call @g(1, x, y) }\n");
  ASSERT_TRUE(m.ok) << m.errors();
  const Body& body = *m.find("f");
  std::string uses;
  forEachRoot(m.module, body, body.stmt(body.first), [&](ExprId, Use use) {
    uses += use == Use::Read ? "r" : use == Use::Write ? "w" : "R";
  });
  EXPECT_EQ(uses, "rRRw");
}

}  // namespace
}  // namespace rung::ir
