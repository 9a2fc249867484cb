// SPDX-License-Identifier: Apache-2.0
// The verifier: for each number of its list a module that breaks this rule and no other.
#include "ir/verify.h"

#include <gtest/gtest.h>

#include "ir/walk.h"
#include "ir_text.h"

namespace rung::ir {
namespace {

// Declares everything that the statements of the tests use.
std::string withStatements(const std::string& statements, const std::string& attributes = "faults") {
  return "struct @Point { x: real; link: pointer to @Point }\n"
         "block @Ramp { in up: bool; inout level: real }\n"
         "body @Ramp { }\n"
         "function @swap { inout a: int; out b: int; result int }\n"
         "body @swap { }\n"
         "function @f " +
         attributes +
         " { in i: int; in b: bool; in r: real; in big: array[0..1] of int; result int }\n"
         "body @f {\n"
         "  var w: word\n"
         "  var s: string[8]\n"
         "  var pt: @Point\n"
         "  var m: array[1..3, 1..2] of int\n"
         "  var ptr: pointer to int\n"
         "  var ramp: @Ramp\n" +
         statements + "\n}\n";
}

void expectOnly(int rule, const std::vector<std::string>& problems) {
  EXPECT_FALSE(problems.empty()) << "rule " << rule << " is not broken";
  for (const std::string& line : problems)
    EXPECT_EQ(line.substr(0, line.find(']')), "[" + std::to_string(rule)) << line;
}

void expectBroken(int rule, const std::string& text) {
  TestModule m(text);
  ASSERT_TRUE(m.ok) << m.errors();
  expectOnly(rule, verify(m.module));
}
void expectStatementBroken(int rule, const std::string& statements) { expectBroken(rule, withStatements(statements)); }

// Breaks a good module by hand where the text form cannot.
template <class F>
void expectBrokenBy(int rule, const std::string& statements, F&& change) {
  TestModule m(withStatements(statements));
  ASSERT_TRUE(m.ok) << m.errors();
  ASSERT_TRUE(verify(m.module).empty()) << verify(m.module)[0];
  change(m, *m.find("f"));
  expectOnly(rule, verify(m.module));
}

Expr& firstOf(Body& body, ExprKind kind) {
  for (Expr& e : body.exprs)
    if (e.kind == kind) return e;
  ADD_FAILURE() << "no such node";
  return body.exprs[0];
}

TEST(Verify, GoodModuleHasNoProblems) {
  TestModule m(withStatements("  w = 3\n  s = string[20]#'text'\n  call @Ramp on ramp\n  bind ramp.level = r"));
  ASSERT_TRUE(m.ok) << m.errors();
  for (const std::string& line : verify(m.module)) ADD_FAILURE() << line;
}

TEST(Verify, Rule1Names) {
  expectBroken(1, "globals @A { x: int }\nlist @A: @A\nlist @A: @A\n");
  expectBroken(1, "task t cyclic\ntask t cyclic\n");
}
TEST(Verify, Rule2Instances) { expectBroken(2, "instance $m: int\n"); }
TEST(Verify, Rule3RecordOrder) { expectBroken(3, "struct @A { b: array[0..1] of @B }\nstruct @B { x: int }\n"); }
TEST(Verify, Rule4Data) { expectBroken(4, "data 0: array[0..1] of int \"010203\"\n"); }
TEST(Verify, Rule5Trees) {
  expectBrokenBy(5, "  i = 1\n  i = 2", [](TestModule&, Body& body) {
    AssignStmt& second = body.stmt(body.stmt(body.first).next).as<AssignStmt>();
    second.value = body.stmt(body.first).as<AssignStmt>().value;
  });
  expectBrokenBy(5, "  i = 1",
                 [](TestModule&, Body& body) { body.stmt(body.first).as<AssignStmt>().value = ExprId{1000}; });
  expectBrokenBy(5, "  i = 1\n  i = 2",
                 [](TestModule&, Body& body) { body.stmt(body.stmt(body.first).next).next = body.first; });
}
TEST(Verify, Rule6Types) {
  expectBrokenBy(6, "  i = 1", [](TestModule&, Body& body) { body.locals[1].type = types::kError; });
}
TEST(Verify, Rule7Locals) {
  expectBrokenBy(7, "  i = 1", [](TestModule&, Body& body) { body.locals[2].by_reference = true; });
  expectBrokenBy(7, "  i = 1", [](TestModule&, Body& body) { body.locals[0].name = body.locals[1].name; });
}
TEST(Verify, Rule8Self) {
  expectBrokenBy(8, "  i = 1", [](TestModule& m, Body&) {
    m.find("Ramp")->self = {};
    m.module.records[1].body = {};
  });
}
TEST(Verify, Rule9Constants) {
  expectBrokenBy(9, "  i = 1",
                 [](TestModule&, Body& body) { firstOf(body, ExprKind::Const).set(ConstExpr{.bits = 70000}); });
  expectBrokenBy(9, "  r = 1.0", [](TestModule&, Body& body) {
    firstOf(body, ExprKind::Const).set(ConstExpr{.bits = 0x3ff0000000000001});
  });
  expectStatementBroken(9, "  evaluate int#zero");
}
TEST(Verify, Rule10Variables) {
  expectStatementBroken(10, "  i = int%I2");
  expectBroken(10, "area I input 4\nfunction @f { in i: int }\nbody @f { i = int%I2.3 }\n");
  expectBrokenBy(10, "  i = 1",
                 [](TestModule&, Body& body) { firstOf(body, ExprKind::Local).set(LocalExpr{.local = 99}); });
}
TEST(Verify, Rule11Fields) { expectStatementBroken(11, "  pt.x! = 1.0"); }
TEST(Verify, Rule12Indices) {
  expectStatementBroken(12, "  m[1] = 3");
  expectStatementBroken(12, "  m[1, r] = 3");
  expectStatementBroken(12, "  m[1, 1]!(null) = 3");
}
TEST(Verify, Rule13Deref) { expectStatementBroken(13, "  ptr^!(index) = 3"); }
TEST(Verify, Rule14Parts) {
  expectStatementBroken(14, "  b = i.%X16");
  expectStatementBroken(14, "  b = r.%X1");
}
TEST(Verify, Rule15Operators) {
  expectStatementBroken(15, "  i = add int i, r");
  expectStatementBroken(15, "  r = div!(div) real r, 2.0");
  expectStatementBroken(15, "  w = shl word w, r");
}
TEST(Verify, Rule16Convert) {
  expectStatementBroken(16, "  i = convert int pt");
  expectStatementBroken(16, "  i = convert!(index) int w");
}
TEST(Verify, Rule17Select) {
  expectStatementBroken(17, "  i = select int i, 1, 2");
  expectStatementBroken(17, "  i = select int b, r, 2");
}
TEST(Verify, Rule18PureCalls) { expectStatementBroken(18, "  i = @swap(i, w)"); }
TEST(Verify, Rule19Address) { expectStatementBroken(19, "  ptr = address pointer to int (add int i, 1)"); }
TEST(Verify, Rule20Assign) {
  expectStatementBroken(20, "  i = r");
  expectStatementBroken(20, "  (add int i, 1) = 3");
  expectStatementBroken(20, "  big[0] = 3");
}
TEST(Verify, Rule21Bind) {
  expectStatementBroken(21, "  bind ramp.up = b");
  expectStatementBroken(21, "  bind ramp.level = i");
}
TEST(Verify, Rule22Calls) {
  expectStatementBroken(22, "  call @swap(i)");
  expectStatementBroken(22, "  call @swap(3, i)");
  expectStatementBroken(22, "  call @swap(_, i)");
  expectStatementBroken(22, "  call @Ramp");
  expectStatementBroken(22, "  r = call @swap(i, _)");
}
TEST(Verify, Rule23Conditions) { expectStatementBroken(23, "  if i { }"); }
TEST(Verify, Rule24Switch) {
  expectStatementBroken(24, "  switch i { case 1..3 { } case 3 { } }");
  expectStatementBroken(24, "  switch i { case 3..1 { } }");
  expectStatementBroken(24, "  switch r { case 1 { } }");
}
TEST(Verify, Rule25For) {
  expectStatementBroken(25, "  for i = 1 to 3 by 0 { }");
  expectStatementBroken(25, "  for r = 1.0 to 3.0 by 1.0 { }");
  expectStatementBroken(25, "  for i = w to 3 by 1 { }");
  expectStatementBroken(25, "  for i = 1 to r by 1 { }");
  expectStatementBroken(25, "  for m[i, i]! = 1 to 3 by 1 { }");
}
TEST(Verify, Rule26Break) {
  expectStatementBroken(26, "  break");
  expectStatementBroken(26, "  loop { } next { continue }");
}
TEST(Verify, Rule27Labels) {
  expectStatementBroken(27, "  jump nowhere");
  expectStatementBroken(27, "  label a\n  label a");
  expectStatementBroken(27, "  jump a\n  if b {\n  label a\n  }");
}
TEST(Verify, Rule28Faults) {
  expectStatementBroken(28, "  try { } catch r { }");
  expectBrokenBy(28, "  fault div", [](TestModule&, Body& body) {
    body.stmt(body.first).set(FaultStmt{.fault = static_cast<types::Fault>(99)});
  });
}
TEST(Verify, Rule29Purity) {
  expectBroken(29, withStatements("  i = div! int i, i", ""));
  expectBroken(29, withStatements("  fault div", ""));
  expectBroken(29, "globals @G { x: int }\nlist @G: @G\nfunction @f pure { in i: int }\nbody @f { @G.x = i }\n");
}
TEST(Verify, Rule31Dispatch) {
  const std::string base =
      "block @Base { var id: udint }\nblock @Pump { var SUPER: @Base }\nfunction @Base__Run on @Base faults { in x: "
      "int }\n"
      "body @Base__Run { }\nfunction @Pump__Run on @Pump { in y: int }\nbody @Pump__Run { }\n"
      "function @Shape__Run on @Base abstract { in x: int }\n";
  const auto call = [](const std::string& how) {
    return "function @go faults { inout b: @Base }\nbody @go { call " + how + "(1) on b }\n";
  };
  const std::string classes = "classes @Base, @Pump of @Base\n";
  TestModule ok(base + classes + "dispatch @Base__Run from 1: @Base__Run, _\n" + call("virtual @Base__Run"));
  ASSERT_TRUE(ok.ok) << ok.errors();
  EXPECT_TRUE(verify(ok.module).empty()) << verify(ok.module)[0];
  expectBroken(31, base + "classes @Pump of @Base, @Base\n");
  expectBroken(31, base + classes + "dispatch @Base__Run from 2: @Base__Run, @Base__Run\n");
  expectBroken(31, base + classes + "dispatch @Base__Run from 1: @Base__Run, @Pump__Run\n" +
                       "function @Other on @Base { }\n" + "dispatch @Other from 1: @Base__Run\n");
  expectBroken(31, base + classes + call("virtual @Base__Run"));
  expectBroken(31, base + classes + call("@Shape__Run"));
}
TEST(Verify, Rule30Native) { expectBroken(30, "function @f native Standard { in i: int }\nbody @f { i = 1 }\n"); }

}  // namespace
}  // namespace rung::ir
