// SPDX-License-Identifier: Apache-2.0
// Rules of calls: pins, directions, counts, in-outs, generics.
#include <gtest/gtest.h>

#include "tests/unit/sema_bodies/checked.h"

namespace rung::sema_test {
namespace {

constexpr char kVars[] =
    "f : BOOL; counter : INT; big : DINT; r : REAL; s : STRING; t : TON; e : (Off, Run); "
    "timers : ARRAY[1..3] OF TON; c5 : ARRAY[0..1] OF INT;";

struct Row {
  const char* source;
  const char* codes;
};
class CallTest : public testing::TestWithParam<Row> {};
TEST_P(CallTest, GivesItsCode) { EXPECT_EQ(codesOf(kVars, GetParam().source), GetParam().codes) << GetParam().source; }

INSTANTIATE_TEST_SUITE_P(
    Calls, CallTest,
    testing::Values(
        Row{"t(IN := f, PTX := T#1s);", "1:12 E0601"}, Row{"t(IN := f, PT = T#1s);", "1:15 E0619"},
        Row{"undefinedFn(1);", "1:1 E0401"}, Row{"counter := undefinedFn(1);", "1:12 E0401"},
        Row{"counter(1);", "1:1 E0610"}, Row{"TON(IN := f);", "1:1 E0611"}, Row{"t(IN := f, IN := f);", "1:12 E0603"},
        Row{"t(Q := f);", "1:3 E0607"}, Row{"t(IN => f);", "1:3 E0606"}, Row{"f := t(IN := f);", "1:6 E0614"},
        Row{"t(IN := counter);", "1:9 E0501"}, Row{"t(Q => counter);", "1:8 E0501"}, Row{"t(Q => TRUE);", "1:8 E0701"},
        Row{"t(f, T#1s);", ""}, Row{"timers[2](IN := f, PT := T#1s);", ""}, Row{"timers[4](IN := f);", "1:8 E0506"},
        Row{"counter := MAX(1);", "1:17 E0605"}, Row{"counter := LIMIT(1, 2);", "1:22 E0605"},
        Row{"counter := ABS(1, 2);", "1:19 E0604"}, Row{"counter := LEN(counter);", "1:16 E0616"},
        Row{"counter := MAX(counter, s);", "1:12 E0508"}, Row{"counter := INT_TO_DINT(counter);", "1:12 W0503"},
        Row{"counter := REAL_TO_INT();", "1:12 E0615"}, Row{"counter := INT_TO_REEL(1);", "1:12 E0401"},
        Row{"t(ENO => f, EN := f);", ""}, Row{"ASSERT(counter);", "1:8 E0501"}, Row{"ASSERT_EQ(1);", "1:1 E0615"},
        Row{"ASSERT_EQ(Run, e);", ""}, Row{"counter := SEL(f, 1, s);", "1:12 E0508"},
        Row{"counter := DIV(counter, 0);", "1:25 E0505"}, Row{"counter := SQRT(f);", "1:17 E0501"}));

std::string messagesOf(const std::string& source) { return Checked(source).messages(); }

TEST(Calls, InOutsNeedAVariableOfTheType) {
  const std::string mixer =
      "FUNCTION_BLOCK Mixer VAR_IN_OUT level : REAL; END_VAR level := level + 1.0; END_FUNCTION_BLOCK\n"
      "PROGRAM Main VAR m : Mixer; tank : REAL; n : INT; END_VAR\n";
  EXPECT_EQ(Checked(mixer + "m(level := tank); END_PROGRAM").codes(), "2:42 W0758\n");
  EXPECT_EQ(Checked(mixer + "m(); END_PROGRAM").codes(), "3:1 E0602\n");
  EXPECT_EQ(Checked(mixer + "m(level := 1.0); END_PROGRAM").codes(), "3:12 E0701\n");
  EXPECT_EQ(Checked(mixer + "m(level := n); END_PROGRAM").codes(), "3:12 E0609\n");
}

TEST(Calls, AMisspelledPinIsSuggested) {
  EXPECT_EQ(messagesOf("PROGRAM Main VAR t : TON; END_VAR\nt(INN := TRUE); END_PROGRAM"),
            "2:3 `TON` has no pin `INN`\n  did you mean `IN`?\n");
}

TEST(Calls, RecursionIsFound) {
  EXPECT_EQ(Checked("FUNCTION F : INT VAR_INPUT n : INT; END_VAR F := G(n); END_FUNCTION\n"
                    "FUNCTION G : INT VAR_INPUT n : INT; END_VAR G := F(n); END_FUNCTION\n")
                .messages(),
            "2:50 recursion: `F` calls `G` calls `F`; its stack use is not checked\n");
}

TEST(Calls, AFunctionWithoutResultHasNoValue) {
  EXPECT_EQ(Checked("FUNCTION Show VAR_INPUT n : INT; END_VAR ; END_FUNCTION\n"
                    "PROGRAM Main VAR x : INT; END_VAR\nShow(1);\nx := Show(1); END_PROGRAM\n")
                .codes(),
            "4:6 E0613\n");
}

}  // namespace
}  // namespace rung::sema_test
