// SPDX-License-Identifier: Apache-2.0
// Rules of expressions: one mistake gives one code at the narrowest token.
#include <gtest/gtest.h>

#include "frontend/source/dialect.h"
#include "tests/unit/sema_bodies/checked.h"

namespace rung::sema_test {
namespace {

constexpr char kVars[] =
    "flag : BOOL; counter : INT; big : DINT; u : UINT; r : REAL; l : LREAL; bt : BYTE; w : WORD; t : TIME; s : STRING; "
    "arr : ARRAY[1..5] OF INT; grid : ARRAY[0..1, 0..1] OF REAL; tm : TON; e : (Off, Run, Stop); sub : INT(0..9);";

struct Row {
  const char* source;
  const char* codes;
};
class ExpressionTest : public testing::TestWithParam<Row> {};
TEST_P(ExpressionTest, GivesItsCode) {
  EXPECT_EQ(codesOf(kVars, GetParam().source), GetParam().codes) << GetParam().source;
}

INSTANTIATE_TEST_SUITE_P(
    Conversions, ExpressionTest,
    testing::Values(Row{"flag := counter;", "1:9 E0501"}, Row{"counter := flag;", "1:12 E0501"},
                    Row{"counter := 1.5;", "1:12 E0501"}, Row{"counter := s;", "1:12 E0501"},
                    Row{"s := counter;", "1:6 E0501"}, Row{"counter := big;", "1:12 W0503"}, Row{"big := counter;", ""},
                    Row{"r := counter;", ""}, Row{"r := big;", "1:6 W0503"}, Row{"l := big;", ""},
                    Row{"r := l;", "1:6 W0503"}, Row{"t := 5;", "1:6 E0501"}, Row{"counter := t;", "1:12 E0501"},
                    Row{"arr := counter;", "1:8 E0502"}, Row{"flag := 2;", "1:9 E0502"}, Row{"flag := 1;", ""},
                    Row{"w := counter;", "1:6 W0503"}, Row{"e := 1;", ""}, Row{"e := 99;", "1:6 W0549"},
                    Row{"e := counter;", "1:6 W0561"}, Row{"e := Fast;", "1:6 E0401"}, Row{"counter := e;", ""}));

INSTANTIATE_TEST_SUITE_P(
    Constants, ExpressionTest,
    testing::Values(Row{"counter := 70000;", "1:12 E0504"}, Row{"counter := -32769;", "1:12 E0504"},
                    Row{"counter := -32768;", ""}, Row{"counter := 30000 + 30000;", "1:12 W0583"},
                    Row{"bt := 256;", "1:7 E0504"}, Row{"u := -1;", "1:6 W0562"},
                    Row{"counter := SINT#200;", "1:12 E0504"}, Row{"counter := 5 / 0;", "1:16 E0505"},
                    Row{"counter := counter MOD 0;", "1:24 E0505"}, Row{"r := r / 0.0;", "1:10 W0582"},
                    Row{"arr[9] := 1;", "1:5 E0506"}, Row{"arr[0] := 1;", "1:5 E0506"}, Row{"arr[5] := 1;", ""},
                    Row{"grid[0, 2] := 1.0;", "1:9 E0506"}, Row{"sub := 10;", "1:8 W0559"},
                    Row{"r := 1 / 2;", "1:8 W0557"}, Row{"t := -T#1s;", ""}, Row{"s := 'x';", ""}));

INSTANTIATE_TEST_SUITE_P(
    Operators, ExpressionTest,
    testing::Values(Row{"flag := flag + flag;", "1:14 E0507"}, Row{"counter := counter + s;", "1:20 E0507"},
                    Row{"flag := flag AND counter;", "1:14 E0508"}, Row{"flag := NOT r;", "1:9 E0507"},
                    Row{"counter := counter + flag;", "1:20 E0507"}, Row{"flag := counter = s;", "1:17 E0508"},
                    Row{"flag := r = l;", "1:11 W0556"}, Row{"flag := r <> 0.0;", ""},
                    Row{"r := r MOD 2.0;", "1:8 E0507"}, Row{"t := t * t;", "1:8 E0508"},
                    Row{"flag := t > counter;", "1:11 E0508"}, Row{"flag := arr = arr;", "1:13 E0507"},
                    Row{"counter := -flag;", "1:12 E0507"}));

INSTANTIATE_TEST_SUITE_P(
    Names, ExpressionTest,
    testing::Values(Row{"countr := 1;", "1:1 E0401"}, Row{"counter := conter + othr;", "1:12 E0401, 1:21 E0401"},
                    Row{"tm.NOPE := TRUE;", "1:4 E0329"}, Row{"flag := tm.start = T#0s;", "1:12 E0529"},
                    Row{"tm.Q := TRUE;", "1:4 E0532"}, Row{"counter := counter.x;", "1:20 E0509"},
                    Row{"counter := arr;", "1:12 E0502"}, Row{"counter[1] := 2;", "1:1 E0511"},
                    Row{"r := grid[1];", "1:11 E0512"}, Row{"arr[r] := 1;", "1:5 E0513"}, Row{"flag := w.15;", ""},
                    Row{"flag := w.16;", "1:11 E0517"}, Row{"counter := TON;", "1:12 E0518"},
                    Row{"counter := MAX;", "1:12 E0518"}, Row{"counter := counter^;", "1:19 E0515"}));

TEST(Expressions, IecForbidsWhatCodesysAllows) {
  const auto iec = [](const char* source) { return codesOf(kVars, source, Dialect::Iec3); };
  EXPECT_EQ(iec("counter := big;"), "1:12 E0503");
  EXPECT_EQ(iec("bt := bt + 1;"), "1:10 E0523");
  EXPECT_EQ(iec("tm.PT := T#1s;"), "");
  EXPECT_EQ(iec("t := tm.PT;"), "1:9 E0530");
  EXPECT_EQ(iec("counter := e;"), "1:12 E0501");
  EXPECT_EQ(iec("big := counter;"), "");
}

TEST(Expressions, DeepNestingIsRefusedNotOverflown) {
  std::string sum = "1";
  for (int i = 0; i < 200000; ++i) sum += "+1";
  EXPECT_NE(codesOf("x : DINT;", "x := " + sum + ";"), "");
}

}  // namespace
}  // namespace rung::sema_test
