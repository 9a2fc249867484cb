// SPDX-License-Identifier: Apache-2.0
// Neutral form: a program of the project in, plain source of the standard out.
#include "tools/conformance/neutral.h"

#include <gtest/gtest.h>

namespace rung::conformance {
namespace {

Program programOf(const std::string& text) {
  Program program;
  program.path = "tests/conformance/x/case.st";
  program.text = text;
  program.features = {"1/1"};
  return program;
}

std::vector<Draft> draftsOf(const std::string& text) { return neutralDrafts(programOf(text)); }

// The only draft of a program with one test.
Draft draftOf(const std::string& text) {
  const std::vector<Draft> drafts = draftsOf(text);
  EXPECT_EQ(drafts.size(), 1u);
  return drafts.at(0);
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Neutral, AnAssertionIsAVariable) {
  const Draft draft = draftOf(
      "{test}\nPROGRAM sums\nVAR a : INT := 2; END_VAR\nASSERT_EQ(4, a + 2);\nASSERT(a < 3, 'small');\n"
      "ASSERT_NEAR(1.0, 1.5, 0.6);\nEND_PROGRAM\n");
  EXPECT_EQ(draft.reason, "");
  EXPECT_EQ(draft.watch, (std::vector<std::string>{"suite.check_1", "suite.check_2", "suite.check_3"}));
  EXPECT_EQ(draft.checks, (std::vector<std::string>{"4 = (a + 2)", "a < 3", "ABS(1.5 - 1.0) <= 0.6"}));
  EXPECT_FALSE(contains(draft.text, "ASSERT"));
  EXPECT_FALSE(contains(draft.text, "{"));
  EXPECT_TRUE(contains(draft.text, "VAR check_1, check_2, check_3 : INT; END_VAR"));
  EXPECT_TRUE(contains(draft.text, "PROGRAM suite WITH suite_task : sums;"));
}

TEST(Neutral, TheVariablesOfChecksHaveFreeNames) {
  const Draft draft =
      draftOf("{test}\nPROGRAM p\nVAR check_1 : BOOL := TRUE; END_VAR\nASSERT(check_1);\nEND_PROGRAM\n");
  EXPECT_EQ(draft.watch, std::vector<std::string>{"suite.verdict_1"});
}

TEST(Neutral, WhatTheStandardLeavesOpenIsNotChecked) {
  Program program =
      programOf("{test}\nPROGRAM p\nVAR a : INT; END_VAR\nASSERT_EQ(0, a);\nASSERT_EQ(1, a + 1);\nEND_PROGRAM\n");
  program.choices = {"p:0 = a", "other:1 = (a + 1)"};
  const std::vector<Draft> drafts = neutralDrafts(program);
  ASSERT_EQ(drafts.size(), 1u);
  EXPECT_EQ(drafts[0].checks, std::vector<std::string>{"1 = (a + 1)"});
}

TEST(Neutral, AnEmptyStatementAfterTheVariablesStaysInTheBody) {
  const Draft draft = draftOf("{test}\nPROGRAM p\nVAR a : INT; END_VAR\n;\nASSERT(a = 0);\nEND_PROGRAM\n");
  EXPECT_TRUE(contains(draft.text, "END_VAR VAR check_1 : INT; END_VAR\n;")) << draft.text;
}

TEST(Neutral, OneDraftForEachTestWithWhatItReaches) {
  const std::vector<Draft> drafts = draftsOf(
      "FUNCTION Used : INT\nUsed := 1;\nEND_FUNCTION\nFUNCTION Unused : INT\nUnused := 2;\nEND_FUNCTION\n"
      "{test}\nPROGRAM first\nASSERT_EQ(1, Used());\nEND_PROGRAM\n{test}\nPROGRAM second\nASSERT_EQ(2, "
      "Unused());\nEND_PROGRAM\n");
  ASSERT_EQ(drafts.size(), 2u);
  EXPECT_TRUE(contains(drafts[0].text, "FUNCTION Used"));
  EXPECT_FALSE(contains(drafts[0].text, "Unused"));
  EXPECT_FALSE(contains(drafts[0].text, "second"));
  EXPECT_TRUE(contains(drafts[1].text, "FUNCTION Unused"));
}

TEST(Neutral, GlobalsBelongToAConfiguration) {
  const Draft draft = draftOf(
      "VAR_GLOBAL speed : INT := 5; END_VAR\nVAR_GLOBAL CONSTANT most : INT := 9; END_VAR\nVAR_GLOBAL other : INT; "
      "END_VAR\n"
      "FUNCTION_BLOCK Reader\nVAR_OUTPUT y : INT; END_VAR\ny := speed;\nEND_FUNCTION_BLOCK\n"
      "{test}\nPROGRAM p\nVAR r : Reader; END_VAR\nr();\nASSERT(r.y < most);\nEND_PROGRAM\n");
  EXPECT_TRUE(contains(draft.text, "VAR_EXTERNAL speed : INT; END_VAR VAR_OUTPUT y"));
  EXPECT_TRUE(contains(draft.text, "VAR_EXTERNAL CONSTANT most : INT; END_VAR VAR r"));
  EXPECT_TRUE(contains(draft.text, "CONFIGURATION suite_configuration\nVAR_GLOBAL speed : INT := 5; END_VAR"));
  EXPECT_FALSE(contains(draft.text, "other"));
}

TEST(Neutral, GlobalsOfAConfigurationAreDeclared) {
  const Draft draft = draftOf(
      "CONFIGURATION c\nVAR_GLOBAL speed : INT := 5; END_VAR\nRESOURCE r ON PLC\nVAR_GLOBAL CONSTANT most : INT := 9; "
      "END_VAR\nTASK t(INTERVAL := T#10ms, PRIORITY := 1);\nPROGRAM q WITH t : p;\nEND_RESOURCE\nEND_CONFIGURATION\n"
      "{test}\nPROGRAM p\nVAR n : INT; END_VAR\nn := speed;\nASSERT(n < most);\nEND_PROGRAM\n");
  EXPECT_TRUE(
      contains(draft.text, "VAR_EXTERNAL speed : INT; END_VAR VAR_EXTERNAL CONSTANT most : INT; END_VAR VAR n"));
  EXPECT_TRUE(contains(draft.text, "CONFIGURATION c\nVAR_GLOBAL speed : INT := 5; END_VAR"));
}

TEST(Neutral, FormsThatEveryEditionHas) {
  const Draft draft = draftOf(
      "TYPE Pair : STRUCT a, b : INT := 1; END_STRUCT END_TYPE  // two\n"
      "{test}\nPROGRAM p\nVAR q : Pair; s : STRING(20); END_VAR\nIF q.a = 1 THEN q.b := 2; END_IF\nASSERT_EQ(2, "
      "q.b);\nEND_PROGRAM\n");
  EXPECT_TRUE(contains(draft.text, "STRUCT a : INT := 1; b : INT := 1; END_STRUCT;"));
  EXPECT_TRUE(contains(draft.text, "(* two *)"));
  EXPECT_TRUE(contains(draft.text, "s : STRING[20];"));
  EXPECT_TRUE(contains(draft.text, "END_IF;"));
}

TEST(Neutral, OneNameInEachDeclarationOfVarExternal) {
  const Draft draft = draftOf(
      "CONFIGURATION c\nVAR_GLOBAL a, b : BOOL; END_VAR\nRESOURCE r ON PLC\nTASK t(INTERVAL := T#10ms, PRIORITY := "
      "1);\n"
      "END_RESOURCE\nEND_CONFIGURATION\n{test}\nPROGRAM p\nVAR_EXTERNAL a, b : BOOL; END_VAR\nASSERT(a = "
      "b);\nEND_PROGRAM\n");
  EXPECT_TRUE(contains(draft.text, "VAR_EXTERNAL a : BOOL; b : BOOL; END_VAR"));
}

TEST(Neutral, LocatedVariablesHaveSectionsOfTheirOwn) {
  const Draft draft = draftOf(
      "{test}\nPROGRAM p\nVAR RETAIN a : INT; b AT %MX1.0 : BOOL; c AT %MX1.1 : BOOL; d : INT; END_VAR\n"
      "ASSERT(b);\nEND_PROGRAM\n");
  EXPECT_TRUE(
      contains(draft.text,
               "VAR RETAIN a : INT; END_VAR VAR RETAIN b AT %MX1.0 : BOOL; c AT %MX1.1 : BOOL; END_VAR VAR RETAIN "
               "d : INT; END_VAR"));
}

TEST(Neutral, ActionsHaveTheirQualifier) {
  const Draft draft = draftOf(
      "FUNCTION_BLOCK Chart\nVAR_OUTPUT n : INT; END_VAR\nINITIAL_STEP s: Count; END_STEP\nTRANSITION FROM s TO s := "
      "TRUE; END_TRANSITION\n"
      "ACTION Count: n := n + 1; END_ACTION\nEND_FUNCTION_BLOCK\n{test}\nPROGRAM p\nVAR c : Chart; "
      "END_VAR\nc();\nASSERT_EQ(1, c.n);\nEND_PROGRAM\n");
  EXPECT_TRUE(contains(draft.text, "Count(N);"));
}

TEST(Neutral, ListsOfPinsInIlHaveALineForEach) {
  const Draft draft = draftOf(
      "FUNCTION_BLOCK Delay\nVAR_INPUT go : BOOL; END_VAR\nVAR t : TON; END_VAR\nCAL t(IN := go, PT := "
      "T#20ms)\nEND_FUNCTION_BLOCK\n"
      "{test}\nPROGRAM p\nVAR d : Delay; END_VAR\nd();\nASSERT(NOT d.go);\nEND_PROGRAM\n");
  EXPECT_TRUE(contains(draft.text, "CAL t(\nIN := go,\n PT := T#20ms\n)")) << draft.text;
}

TEST(Neutral, TestAdvanceBecomesCycles) {
  const Draft draft = draftOf(
      "{test}\nPROGRAM p\nVAR t : TON; END_VAR\nt(IN := TRUE, PT := "
      "T#1s);\nTEST_ADVANCE(T#1s);\nt();\nASSERT(t.Q);\nEND_PROGRAM\n");
  EXPECT_EQ(draft.reason, "");
  EXPECT_EQ(draft.cycles, 101);
  EXPECT_TRUE(contains(draft.text, "CASE suite_cycle OF\n0:"));
  EXPECT_TRUE(contains(draft.text, "\n100:"));
  EXPECT_TRUE(contains(draft.text, "suite_cycle := suite_cycle + 1;"));
}

TEST(Neutral, TestAdvanceWithinACycleHasNoPlainForm) {
  EXPECT_EQ(
      draftOf("{test}\nPROGRAM p\nVAR n : INT; END_VAR\nTEST_ADVANCE(T#3ms);\nASSERT(n = 0);\nEND_PROGRAM\n").reason,
      "TEST_ADVANCE by what is not a multiple of 10 ms");
  EXPECT_EQ(draftOf("{test}\nPROGRAM p\nVAR n : INT; END_VAR\nIF n = 0 THEN TEST_ADVANCE(T#10ms); END_IF\nASSERT(n = "
                    "0);\nEND_PROGRAM\n")
                .reason,
            "TEST_ADVANCE inside of a statement: time passes within a cycle");
}

TEST(Neutral, ServicesOfTheTestToolAreRefused) {
  EXPECT_EQ(draftOf("{test}\n{skip}\nPROGRAM p\nASSERT(TRUE);\nEND_PROGRAM\n").reason,
            "a service of `rung test`: {case}, {skip} or {mock}");
  EXPECT_EQ(draftOf("{test}\nPROGRAM p\nVAR n : INT; END_VAR\nn := 1;\nEND_PROGRAM\n").reason,
            "the test asserts nothing");
}

TEST(Neutral, ATestThatIsABlockRunsInAProgram) {
  const Draft draft =
      draftOf("{test}\nFUNCTION_BLOCK b\nVAR done : BOOL; END_VAR\nASSERT(TRUE);\ndone := TRUE;\nEND_FUNCTION_BLOCK\n");
  EXPECT_EQ(draft.watch, std::vector<std::string>{"suite.tested.check_1"});
  EXPECT_EQ(draft.done, "suite.tested.done");
  EXPECT_TRUE(contains(draft.text, "PROGRAM run_b"));
}

}  // namespace
}  // namespace rung::conformance
