// SPDX-License-Identifier: Apache-2.0
// One mistake, one error, on its line: typical slips, block words, and twenty mistakes in one file.
#include <gtest/gtest.h>

#include "tests/unit/parse/parse_helper.h"

namespace rung::text {
namespace {

TEST(Recovery, TypicalSlips) {
  struct Row {
    const char* statements;
    const char* codes;
  };
  static constexpr Row kRows[] = {
      {"a := 1\nb := 2;", "2:7 E0201"},
      {"a = 1;", "2:3 E0205"},
      {"a == 1;", "2:3 E0205"},
      {"a : = 1;", "2:3 E0207"},
      {"IF a := 1 THEN b := 1; END_IF", "2:6 W0252"},
      {"IF (a := 1) THEN b := 1; END_IF", ""},
      {"IF 2 := 1 THEN b := 1; END_IF", "2:6 E0206"},
      {"IF (a + 2 := 1) THEN b := 1; END_IF", "2:11 E0206"},
      {"IF a == 1 THEN b := 1; END_IF", "2:6 E0207"},
      {"IF a != 1 THEN b := 1; END_IF", "2:6 E0207"},
      {"IF a && b THEN c := 1; END_IF", "2:6 E0207"},
      {"IF a || b THEN c := 1; END_IF", "2:6 E0207"},
      {"IF !a THEN c := 1; END_IF", "2:4 E0207"},
      {"x := a % 2;", "2:8 E0207"},
      {"IF a\nb := 1;\nEND_IF", "2:5 E0202"},
      {"IF a DO b := 1; END_IF", "2:6 E0234"},
      {"IF a THNE\nb := 1;\nEND_IF", "2:6 E0209"},
      {"IF a {\nb := 1; }\nEND_IF", "2:5 E0231"},
      {"WHILE a\nb := 1;\nEND_WHILE", "2:8 E0202"},
      {"FOR i = 1 TO 3 DO b := 1; END_FOR", "2:7 E0205"},
      {"FOR i := 1 3 DO b := 1; END_FOR", "2:12 E0202"},
      {"CASE a\n1: b := 1;\nEND_CASE", "2:7 E0202"},
      {"CASE a OF\n1 b := 1;\nEND_CASE", "3:2 E0202"},
      {"IF a THEN\nb := 1;\nELSE IF c THEN\nb := 2;\nEND_IF\nx := 1;", "4:1 E0208"},
      {"IF a THEN\nb := 1;\nELSEIF c THEN\nb := 2;\nEND_IF", "4:1 E0209"},
      {"IF a THEN\nb := 1;\nESLE\nb := 2;\nEND_IF", "4:1 E0209"},
      {"IF a THEN\nb := 1;\nEND_FI\nx := 1;", "4:1 E0209"},
      {"IF a THEN\nb := 1;\nENDIF;\nx := 1;", "4:1 E0209"},
      {"IF a THEN\nb := 1;\nEND IF;\nx := 1;", "4:1 E0209"},
      {"f(a, b;", "2:7 E0202"},
      {"f(a b);", "2:5 E0202"},
      {"x := (a + b;", "2:12 E0202"},
      {"x := (a + b));", "2:13 E0232"},
      {"x := a +;", "2:9 E0203"},
      {"x := a +\ny := 1;", "2:9 E0233"},
      {"x := * a;", "2:6 E0203"},
      {"x := a b;", "2:8 E0204"},
      {"x y := 1;", "2:1 E0213"},
      {"RETRUN;", "2:1 E0209"},
      {"x := a[1;", "2:9 E0202"},
      {"x := a.;", "2:8 E0214"},
      {"x : INT;", "2:1 E0224"},
  };
  for (const Row& row : kRows) EXPECT_EQ(statementErrors(row.statements), row.codes) << row.statements;
}

TEST(Recovery, BlockKeywords) {
  // The indentation shows which END_… is missing; the END_… of the outer block then belongs to that block.
  EXPECT_EQ(statementErrors("IF a THEN\n  IF b THEN\n    c := 1;\n  ;\n  d := 1;\nEND_IF\ne := 1;"), "5:3 E0210");
  EXPECT_EQ(statementErrors("FOR i := 1 TO 2 DO\n  WHILE b DO\n    c := 1;\n  ;\nEND_FOR\ne := 1;"), "5:3 E0210");
  EXPECT_EQ(statementErrors("IF a THEN\n  c := 1;\nEND_FOR\ne := 1;"), "4:1 E0212");
  EXPECT_EQ(statementErrors("WHILE a THEN\n  c := 1;\nEND_IF\ne := 1;"), "2:1 E0234");
  EXPECT_EQ(statementErrors("a := 1;\nEND_IF\nb := 1;"), "3:1 E0211");
  EXPECT_EQ(statementErrors("a > 1 THEN\n  c := 1;\nEND_IF\ne := 1;"), "2:1 E0227");
  EXPECT_EQ(statementErrors("WHIEL a DO\n  c := 1;\nEND_WHILE\ne := 1;"), "2:1 E0209");
  // The layout of a balanced program never matters.
  EXPECT_EQ(statementErrors("      IF a THEN\nIF b THEN\n  c := 1;\n          END_IF\n  END_IF"), "");
  EXPECT_EQ(statementErrors("IF a THEN b := 1; ELSE IF c THEN b := 2; END_IF END_IF"), "");
}

TEST(Recovery, Pous) {
  EXPECT_EQ(
      Parsed("FUNCTON_BLOCK a\nVAR x : INT; END_VAR\nx := 1;\nEND_FUNCTION_BLOCK\nPROGRAM b\nEND_PROGRAM\n").codes(),
      "1:1 E0209");
  EXPECT_EQ(Parsed("PROGRAM a\nVAR_INPTU\n  x : INT;\nEND_VAR\nx := 1;\nEND_PROGRAM\n").codes(), "2:1 E0209");
  EXPECT_EQ(Parsed("PROGRAM a\nVAR\n  x : INT;\n\nx := 1;\nEND_PROGRAM\n").codes(), "4:1 E0210");
  EXPECT_EQ(Parsed("PROGRAM a\nVAR\n  x INT;\n  y : INT\n  z : ;\n  w : INT = 5;\nEND_VAR\nEND_PROGRAM\n").codes(),
            "3:5 E0202 4:10 E0201 5:7 E0216 6:11 E0205");
  EXPECT_EQ(Parsed("TYPE t : STRUCT\n  a : INT;\n  ;\nEND_TYPE\n").codes(), "4:1 E0210");
  EXPECT_EQ(Parsed("x := 1;\ny := 2;\nPROGRAM a\nEND_PROGRAM\n").codes(), "1:1 E0219");
  EXPECT_EQ(Parsed("PROGRAM a VAR x : ARRAY[10] OF INT; END_VAR END_PROGRAM").codes(), "1:25 E0226");
}

TEST(Recovery, TwentyMistakes) {
  const Parsed parsed(R"(TYPE
  t : (A, B C);
  u : ARRAY [1..] OF INT;
END_TYPE
FUNCTION_BLOCK f
VAR_INPUT
  a INT;
  b : ;
  c : BOOL
END_VAR
VAR
  d : INT == 4;
  DT : REAL;
END_VAR
a = 1;
b := ;
IF (a + 1) := 2 THEN
  b := 3
END_IF
FOR i := 1 5 DO
  x := (a + b;
END_FOR
WHILE a != b DO
  f(a b);
END_WHILE
CASE a OF
  1 b := 1;
  2: b := 2 +;
END_CASE
x := T#5q;
x := 'open;
RETRUN;
x := a b;
END_FUNCTION_BLOCK
PROGRAM
END_PROGRAM
)");
  EXPECT_EQ(parsed.diagnostics.errorCount(), 22u) << parsed.codes();
}

}  // namespace
}  // namespace rung::text
