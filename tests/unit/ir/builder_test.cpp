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

}  // namespace
}  // namespace rung::ir
