// SPDX-License-Identifier: Apache-2.0
// The tree after the check: types of literals, implicit conversions, resolved calls.
#include <gtest/gtest.h>

#include "tests/unit/sema_bodies/checked.h"

namespace rung::sema_test {
namespace {

constexpr char kVars[] =
    "b : BOOL; i : INT; d : DINT; u : UINT; r : REAL; l : LREAL; bt : BYTE; w : WORD; t : TIME; lt : LTIME; dt1 : DT; "
    "dt2 : DT; td : TOD; s : STRING; s20 : STRING[20]; a : ARRAY[1..5] OF INT; sub : INT(0..9); tm : TON; "
    "e : (Off, Run, Stop);";

struct Row {
  const char* source;
  const char* tree;
};

class TreeTest : public testing::TestWithParam<Row> {};
TEST_P(TreeTest, IsTyped) {
  EXPECT_EQ(treeOf(kVars, GetParam().source), std::string(GetParam().tree) + "\n") << GetParam().source;
}

INSTANTIATE_TEST_SUITE_P(Literals, TreeTest,
                         testing::Values(Row{"i := 5;", "i := INT#5;"}, Row{"r := 5;", "r := REAL#5;"},
                                         Row{"l := 0.1;", "l := LREAL#0.1;"}, Row{"i := -32768;", "i := INT#-32768;"},
                                         Row{"w := 16#FFFF;", "w := WORD#65535;"}, Row{"b := 1;", "b := BOOL#1;"},
                                         Row{"d := 70000 - 5;", "d := (DINT#70000 - DINT#5);"},
                                         Row{"i := 70000 - 65000;", "i := INT#5000;"},
                                         Row{"i := 2 * (3 + 4);", "i := (INT#2 * (INT#3 + INT#4));"},
                                         Row{"lt := T#5s;", "lt := LTIME#5000000000;"},
                                         Row{"t := T#5s;", "t := TIME#5000000000;"},
                                         Row{"r := 2 * 1.5;", "r := (REAL#2 * REAL#1.5);"},
                                         Row{"r := -0.5;", "r := - REAL#0.5;"}, Row{"e := Run;", "e := Run;"}));

INSTANTIATE_TEST_SUITE_P(
    Operators, TreeTest,
    testing::Values(
        Row{"d := i + 1;", "d := DINT((i + INT#1));"}, Row{"d := i + d;", "d := (DINT(i) + d);"},
        Row{"r := i * 0.5;", "r := (REAL(i) * REAL#0.5);"}, Row{"l := i * 0.5;", "l := (LREAL(i) * LREAL#0.5);"},
        Row{"l := r * 0.5;", "l := LREAL((r * REAL#0.5));"}, Row{"d := i + 70000;", "d := (DINT(i) + DINT#70000);"},
        Row{"b := i > 70000;", "b := (DINT(i) > DINT#70000);"}, Row{"bt := bt + 1;", "bt := (bt + BYTE#1);"},
        Row{"b := bt = w;", "b := (WORD(bt) = w);"}, Row{"d := u + i;", "d := (DINT(u) + DINT(i));"},
        Row{"b := b AND NOT (i = 3);", "b := (b AND NOT (i = INT#3));"},
        Row{"w := w AND 16#FF;", "w := (w AND WORD#255);"}, Row{"b := Run = e;", "b := (Run = e);"},
        Row{"i := sub;", "i := INT(sub);"}, Row{"sub := i;", "sub := INT(0..9)(i);"},
        Row{"i := sub + 1;", "i := (INT(sub) + INT#1);"}, Row{"b := s = 'x';", "b := (s = 'x');"},
        Row{"r := r ** 2;", "r := (r ** INT#2);"}, Row{"l := 2 ** i;", "l := (LREAL#2 ** i);"},
        Row{"i := e;", "i := INT(e);"}, Row{"d += i;", "d += DINT(i);"},
        Row{"r := 1 / 3.0;", "r := (REAL#1 / REAL#3.0);"}));

INSTANTIATE_TEST_SUITE_P(Times, TreeTest,
                         testing::Values(Row{"t := t + T#1s;", "t := (t + TIME#1000000000);"},
                                         Row{"t := t * 2;", "t := TIME((UDINT(t) * UDINT#2));"},
                                         Row{"t := 2 * t;", "t := TIME((UDINT(t) * UDINT#2));"},
                                         Row{"t := t * r;", "t := TIME(UDINT((LREAL(UDINT(t)) * LREAL(r))));"},
                                         Row{"t := t / i;", "t := TIME((UDINT(t) / UDINT(i)));"},
                                         Row{"t := dt1 - dt2;", "t := TIME(((UDINT(dt1) - UDINT(dt2)) * UDINT#1000));"},
                                         Row{"dt1 := dt1 + t;",
                                             "dt1 := DATE_AND_TIME((UDINT(dt1) + (UDINT(t) / UDINT#1000)));"},
                                         Row{"td := td + t;", "td := TIME_OF_DAY((UDINT(td) + UDINT(t)));"},
                                         Row{"lt := lt + t;", "lt := (lt + LTIME(t));"},
                                         Row{"b := t > T#1s;", "b := (t > TIME#1000000000);"}));

INSTANTIATE_TEST_SUITE_P(
    Calls, TreeTest,
    testing::Values(
        Row{"r := INT_TO_REAL(i);", "r := REAL(i);"}, Row{"i := REAL_TO_INT(r);", "i := INT(r);"},
        Row{"d := TO_DINT(i);", "d := DINT(i);"}, Row{"i := TIME_TO_INT(t);", "i := INT(t);"},
        Row{"i := BOOL_TO_INT(b);", "i := INT(b);"},
        Row{"s := INT_TO_STRING(5);", "s := TO_STRING__INT(IN:=INT(INT#5));"},
        Row{"i := STRING_TO_INT(s20);", "i := STRING_TO_INT(IN:=s20);"},
        Row{"i := TO_INT(s);", "i := STRING_TO_INT(IN:=STRING(s));"},
        Row{"i := ADD(i, 2, 3);", "i := op:ADD(i, INT#2, INT#3);"},
        Row{"i := ADD(IN1 := i, IN3 := 4);", "i := op:ADD(i, , INT#4);"},
        Row{"r := MAX(i, r);", "r := op:MAX(REAL(i), r);"}, Row{"b := GT(i, d, 3);", "b := op:GT(DINT(i), d, DINT#3);"},
        Row{"w := SHL(w, 2);", "w := op:SHL(w, INT#2);"}, Row{"i := SEL(b, 1, i);", "i := op:SEL(b, INT#1, i);"},
        Row{"i := MUX_INT(K := 3, IN0 := 1, IN2 := 2, IN4 := 3);", "i := op:MUX(INT#3, INT#1, , INT#2, , INT#3);"},
        Row{"t := ADD_TIME(t, T#1s);", "t := (t + TIME#1000000000);"},
        Row{"r := LIMIT(0, r, 9.5);", "r := LIMIT__REAL(MN:=REAL#0, IN:=r, MX:=REAL#9.5);"},
        Row{"i := LIMIT(MX := 5, MN := 0, IN := i);", "i := LIMIT__INT(MN:=INT#0, IN:=i, MX:=INT#5);"},
        Row{"r := SQRT(2);", "r := SQRT__REAL(IN:=REAL#2);"}, Row{"l := SQRT(i);", "l := SQRT__LREAL(IN:=LREAL(i));"},
        Row{"tm(IN := b, PT := T#1s, Q => b);", "tm(IN:=b, PT:=TIME#1000000000, Q=>b);"},
        Row{"tm(EN := b, IN := , NOT Q => b, ENO => b);", "tm(EN:=b, NOT Q=>b, ENO=>b);"},
        Row{"b := tm.Q;", "b := tm.Q;"}, Row{"tm.PT := T#2s;", "tm.PT := TIME#2000000000;"},
        Row{"i := SIZEOF(a);", "i := INT#10;"}, Row{"i := ABS(-5);", "i := op:ABS(INT#-5);"},
        Row{"r := INT_TO_REAL(EN := b, IN := i, ENO => b);", "r := op:MOVE(EN:=b, REAL(i), ENO=>b);"},
        Row{"i := Standard.MAX(i, 1);", "i := op:MAX(i, INT#1);"}, Row{"r := EXPT(r, 2);", "r := op:EXPT(r, INT#2);"},
        Row{"ASSERT(b, 'x');", "ASSERT(b, 'x');"}, Row{"ASSERT_EQ(5, d);", "ASSERT(DINT#5, d);"},
        Row{"ASSERT_NEAR(1.0, r, 0.1);", "ASSERT(REAL#1.0, r, REAL#0.1);"}));

TEST(Tree, FunctionNameIsItsResultInsideAndACallOutside) {
  const Checked checked(
      "FUNCTION Twice : INT VAR_INPUT x : INT; END_VAR Twice := x; Twice := Twice + x; END_FUNCTION\n"
      "PROGRAM Main VAR y : INT; END_VAR y := Twice(2); y := Twice(x := y); END_PROGRAM\n");
  EXPECT_EQ(checked.messages(), "");
  EXPECT_EQ(checked.body("Twice"), "Twice := x;\nTwice := (Twice + x);\n");
  EXPECT_EQ(checked.body("Main"), "y := Twice(x:=INT#2);\ny := Twice(x:=y);\n");
}

TEST(Tree, ExtensibleStringFunctionsAreFolded) {
  EXPECT_EQ(treeOf("s : STRING;", "s := CONCAT(s, 'a', 'b');").substr(0, 5), "s := ");
}

}  // namespace
}  // namespace rung::sema_test
