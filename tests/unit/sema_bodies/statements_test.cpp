// SPDX-License-Identifier: Apache-2.0
// Rules of statements: conditions, CASE labels, loops, jumps, targets, unreachable and unused code.
#include <gtest/gtest.h>

#include "frontend/source/dialect.h"
#include "tests/unit/sema_bodies/checked.h"

namespace rung::sema_test {
namespace {

constexpr char kVars[] = "f : BOOL; i : INT; j : INT; d : DINT; r : REAL; bt : BYTE; e : (Off, Run, Stop);";

struct Row {
  const char* source;
  const char* codes;
};
class StatementTest : public testing::TestWithParam<Row> {};
TEST_P(StatementTest, GivesItsCode) {
  EXPECT_EQ(codesOf(kVars, GetParam().source), GetParam().codes) << GetParam().source;
}

INSTANTIATE_TEST_SUITE_P(Branches, StatementTest,
                         testing::Values(Row{"IF i THEN j := 1; END_IF", "1:4 E0501"},
                                         Row{"IF TRUE THEN j := 1; END_IF", "1:4 W0754"},
                                         Row{"CASE i OF 1: j := 1; 1: j := 2; END_CASE", "1:22 E0709"},
                                         Row{"CASE i OF 1..5: j := 1; 3: j := 2; END_CASE", "1:25 E0709"},
                                         Row{"CASE i OF 5..1: j := 1; END_CASE", "1:11 E0708"},
                                         Row{"CASE i OF -5..5, 7: j := 1; END_CASE", ""},
                                         Row{"CASE i OF 70000: j := 1; END_CASE", "1:11 E0504"},
                                         Row{"CASE i OF j: j := 1; END_CASE", "1:11 E0707"},
                                         Row{"CASE r OF 1: j := 1; END_CASE", "1:6 E0706"},
                                         Row{"CASE e OF Off: j := 1; Run, Stop: j := 2; END_CASE", ""},
                                         Row{"CASE e OF Off: j := 1; Off: j := 2; END_CASE", "1:24 E0709"},
                                         Row{"CASE i OF Run: j := 1; 1: j := 2; END_CASE", "1:24 E0709"}));

INSTANTIATE_TEST_SUITE_P(Loops, StatementTest,
                         testing::Values(Row{"EXIT;", "1:1 E0712"}, Row{"CONTINUE;", "1:1 E0712"},
                                         Row{"FOR i := 1 TO 3 DO i := 2; END_FOR", "1:20 W0704"},
                                         Row{"FOR i := 1 TO 3 BY 0 DO j := i; END_FOR", "1:20 E0711"},
                                         Row{"FOR r := 1.0 TO 3.0 DO j := 1; END_FOR", "1:5 E0710"},
                                         Row{"FOR i := 9 TO 1 DO j := i; END_FOR", "1:10 W0755"},
                                         Row{"FOR i := 9 TO 1 BY -1 DO j := i; END_FOR", ""},
                                         Row{"FOR i := 1 TO 40000 DO j := i; END_FOR", "1:10 W0755, 1:15 W0583"},
                                         Row{"FOR bt := 0 TO 255 DO j := bt; END_FOR", "1:16 W0586"},
                                         Row{"WHILE i DO j := 1; END_WHILE", "1:7 E0501"},
                                         Row{"WHILE TRUE DO j := 1; END_WHILE", "1:1 W0756"},
                                         Row{"WHILE TRUE DO EXIT; END_WHILE", ""},
                                         Row{"REPEAT j := 1; UNTIL FALSE END_REPEAT", "1:1 W0756"},
                                         Row{"FOR i := 1 TO 3 DO EXIT; j := 1; END_FOR", "1:26 W0753"},
                                         Row{"RETURN;\nj := 1;", "2:1 W0753"},
                                         Row{"IF f THEN RETURN; ELSE RETURN; END_IF\nj := 1;", "2:1 W0753"}));

INSTANTIATE_TEST_SUITE_P(Targets, StatementTest,
                         testing::Values(Row{"5 := i;", "1:1 E0217"}, Row{"Run := 1;", "1:1 E0701"},
                                         Row{"i S= TRUE;", "1:1 E0705"}, Row{"f S= TRUE;", ""}, Row{"i += 1;", ""},
                                         Row{"i += d;", "1:3 W0503"}, Row{"i += 1.5;", "1:3 E0501"}));

INSTANTIATE_TEST_SUITE_P(Jumps, StatementTest,
                         testing::Values(Row{"again: i := 1;\nIF f THEN JMP again; END_IF", ""},
                                         Row{"JMP agan;\nagain: i := 1;", "1:5 E0713"},
                                         Row{"JMP a; a: i := 1; a: i := 2;", "1:19 E0714"},
                                         Row{"JMP a; IF f THEN a: i := 1; END_IF", "1:5 E0715, 1:8 W0753"}));

TEST(Statements, ConstantsAndInputsAreNotWritten) {
  EXPECT_EQ(Checked("PROGRAM Main VAR CONSTANT limit : INT := 5; END_VAR\nlimit := 3; END_PROGRAM").codes(),
            "2:1 E0702\n");
  const std::string block =
      "FUNCTION_BLOCK B VAR_INPUT x : INT; END_VAR VAR_OUTPUT y : INT; END_VAR\nx := 3; y := x; END_FUNCTION_BLOCK";
  EXPECT_EQ(Checked(block).codes(), "2:1 W0703\n");
  EXPECT_EQ(Checked(block, Dialect::Iec3).codes(), "2:1 E0703\n");
}

TEST(Statements, UnusedAndNeverWrittenAreReportedOnce) {
  EXPECT_EQ(Checked("FUNCTION_BLOCK B VAR_OUTPUT y : INT; z : INT; END_VAR\nVAR a : INT; b : INT; c : INT; END_VAR\n"
                    "c := b; y := c; END_FUNCTION_BLOCK")
                .codes(),
            "1:38 W0760\n2:5 W0758\n2:14 W0759\n");
}

TEST(Statements, AFunctionAssignsItsResult) {
  EXPECT_EQ(Checked("FUNCTION F : INT VAR_INPUT x : INT; END_VAR\nIF x > 0 THEN RETURN; END_IF END_FUNCTION").codes(),
            "1:10 W0757\n");
}

TEST(Statements, AThousandNestedIfsAreFine) {
  std::string source;
  for (int i = 0; i < 1000; ++i) source += "IF f THEN\n";
  source += "i := 1;\n";
  for (int i = 0; i < 1000; ++i) source += "END_IF\n";
  EXPECT_EQ(codesOf(kVars, source), "");
}

}  // namespace
}  // namespace rung::sema_test
