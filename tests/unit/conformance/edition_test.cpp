// SPDX-License-Identifier: Apache-2.0
// Tests which text is of an edition: a text in, the first foreign thing out.
#include "tools/conformance/edition.h"

#include <gtest/gtest.h>

namespace rung::conformance {
namespace {

constexpr const char* kAll = "";

class Edition : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(readVocabulary(RUNG_SOURCE, vocabulary_), ""); }

  std::string foreign(int edition, const std::string& text) const {
    const Source source(text, edition == 2 ? Dialect::Iec2 : Dialect::Iec3);
    return foreignTo(edition, source, vocabulary_);
  }
  // A program with declarations before it, variables, and statements.
  static std::string program(const std::string& before, const std::string& variables, const std::string& body) {
    return before + "\nPROGRAM p\n" + variables + "\n" + body + "\nEND_PROGRAM\n";
  }
  void expect(const std::string& text, const std::string& in_edition_2, const std::string& in_edition_3) const {
    EXPECT_EQ(foreign(2, text), in_edition_2) << text;
    EXPECT_EQ(foreign(3, text), in_edition_3) << text;
  }

  Vocabulary vocabulary_;
};

TEST_F(Edition, PlainSourceIsOfBoth) {
  expect(
      program(
          "TYPE Pair : STRUCT a : INT; b : REAL := 1.5; END_STRUCT; Row : ARRAY[-1..1] OF INT := [2(1), 3]; END_TYPE",
          "VAR x : Pair; r : Row; t : TIME := T#1h2m3s; s : STRING[5] := 'abc'; b : BYTE := 16#FF; END_VAR",
          "FOR x.a := 1 TO 2 DO ; END_FOR;"),
      "a control variable that is not an identifier is not of the standard",
      "a control variable that is not an identifier is not of the standard");
  expect(
      program(
          "TYPE Pair : STRUCT a : INT; b : REAL := 1.5; END_STRUCT; Row : ARRAY[-1..1] OF INT := [2(1), 3]; END_TYPE",
          "VAR x : Pair; i : INT; t : TIME := T#1h2m3s; s : STRING[5] := 'abc'; b : BYTE := 16#FF; END_VAR",
          "FOR i := 1 TO 2 DO x.a := -i; END_FOR; CASE i OF 1..3, -5: x.a := 1; ELSE x.b := 1.0e3; END_CASE;"),
      kAll, kAll);
}

TEST_F(Edition, Keywords) {
  expect(program("", "VAR limit : INT; END_VAR", "limit := 1;"), "`limit` is a keyword of edition 2", kAll);
  expect(program("", "VAR step : INT; END_VAR", "step := 1;"), "`step` is a keyword", "`step` is a keyword");
  EXPECT_EQ(foreign(3, program("", "VAR method : INT; END_VAR", "method := 1;")), "`method` is a keyword of edition 3");
}

TEST_F(Edition, Literals) {
  expect(program("", "VAR x : LREAL; END_VAR", "x := 123e3;"),
         "a REAL literal without a decimal point is not of the standard",
         "a REAL literal without a decimal point is not of the standard");
  expect(program("", "VAR x : LREAL; END_VAR", "x := LREAL#1;"),
         "a REAL literal without a decimal point is not of the standard",
         "a REAL literal without a decimal point is not of the standard");
  expect(program("", "VAR x : LREAL; END_VAR", "x := 1.5E-3; x := LREAL#-2.0;"), kAll, kAll);
  expect(program("", "VAR t : TIME; END_VAR", "t := T#1d5s;"), "a duration that leaves out a unit is of edition 3",
         kAll);
  expect(program("", "VAR t : TIME; END_VAR", "t := T#1d2h3m4s5ms; t := TIME#3s4.5ms; t := t#1.5h;"), kAll, kAll);
  expect(program("",
                 "VAR s : STRING := 'gr\xC3\xB6\xC3\x9F"
                 "e'; END_VAR",
                 "s := '';"),
         "characters outside of ISO/IEC 646 are of edition 3", kAll);
  expect(program("", "VAR w : WORD; b : BOOL; END_VAR", "b := w.3;"), "the part of a bit string is of edition 3", kAll);
}

TEST_F(Edition, Declarations) {
  expect(program("TYPE A : ARRAY[1..2] OF ARRAY[1..2] OF INT; END_TYPE", "VAR a : A; END_VAR", "a[1][1] := 1;"),
         "an array of elements whose type has no name is not of the standard",
         "an array of elements whose type has no name is not of the standard");
  expect(program("TYPE S : STRUCT t : TON; END_STRUCT; END_TYPE", "VAR s : S; END_VAR", ";"),
         "a function block in a structure is of edition 3", kAll);
  expect(program("TYPE T5 : STRING[5]; S : STRUCT t : T5; END_STRUCT; END_TYPE", "VAR s : S; END_VAR", ";"),
         "STRING[n] in a structure is of edition 3", kAll);
  expect(program("", "VAR_TEMP t : INT := 1; END_VAR", "t := 1;"), "an initial value of VAR_TEMP is of edition 3",
         kAll);
  expect("FUNCTION f : STRING[5]\nf := 'a';\nEND_FUNCTION\n", "STRING[n] as a result is of edition 3", kAll);
  expect(program("", "VAR x : INT := 1 + 2; END_VAR", "x := 1;"),
         "initial values that are expressions are of edition 3", kAll);
  expect(program("TYPE B : BYTE (1..3); END_TYPE", "VAR b : B; END_VAR", ";"),
         "a subrange of a bit string is not of the standard", "a subrange of a bit string is not of the standard");
}

TEST_F(Edition, Bodies) {
  expect(program("", "VAR i : INT; END_VAR", "i := +i;"), "the sign + is of edition 3", kAll);
  expect(program("", "VAR i : INT; END_VAR", "IF i = 0 THEN END_IF;"), "an empty list of statements is of edition 3",
         kAll);
  expect(program("", "VAR i : INT; END_VAR", ""), "an empty body is of edition 3", kAll);
  expect(program("", "VAR CONSTANT k : INT := 2; END_VAR VAR i : INT; END_VAR", "CASE i OF k: i := 1; END_CASE;"),
         "a label of CASE that is neither a number nor an item is of edition 3", kAll);
  expect(program("", "VAR a : BOOL; END_VAR", "a := NOT(IN := a);"), "in annex B of edition 2 NOT is an operator of ST",
         kAll);
  expect(program("", "VAR a : BOOL; END_VAR", "a := NOT (a);"), kAll, kAll);
  expect("FUNCTION f : INT\nLD 1\nADD( 5 )\nST f\nEND_FUNCTION\n",
         "a list of operands in parentheses is not of the standard",
         "a list of operands in parentheses is not of the standard");
  expect("FUNCTION f : INT\nLD 1\nADD( 5\nMUL 2\n)\nST f\nEND_FUNCTION\n", kAll, kAll);
  expect("FUNCTION f : INT\nVAR b : BOOL; END_VAR\nLD b\nJMPN away\nLD 1\nST f\naway:\nEND_FUNCTION\n",
         "`JMPN`, N without C, is not of the standard", "`JMPN`, N without C, is not of the standard");
}

TEST_F(Edition, Configurations) {
  const std::string main = "PROGRAM Main\nVAR n : INT; END_VAR\nn := 1;\nEND_PROGRAM\n";
  expect(main +
             "CONFIGURATION c\nRESOURCE r ON PLC\nTASK t(INTERVAL := T#10ms);\nPROGRAM p WITH t : "
             "Main;\nEND_RESOURCE\nEND_CONFIGURATION\n",
         "a TASK without PRIORITY is not of the standard", "a TASK without PRIORITY is not of the standard");
  expect(main + "CONFIGURATION c\nVAR_GLOBAL g : INT; END_VAR\nEND_CONFIGURATION\n",
         "a CONFIGURATION without a program is not of the standard",
         "a CONFIGURATION without a program is not of the standard");
}

TEST_F(Edition, Words) {
  EXPECT_EQ(foreign(3, program("", "VAR p : POINTER TO INT; END_VAR", ";")), "`POINTER` is not of the standard");
  EXPECT_EQ(foreign(2, program("", "VAR t : LTIME; END_VAR", ";")), "`LTIME` is of edition 3");
  EXPECT_EQ(foreign(2, program("", "VAR c : CTD; END_VAR", "c(LD := TRUE, PV := 3);")), "");
  const Source broken("PROGRAM p\nVAR r : REF_TO INT END_VAR\nEND_PROGRAM\n", Dialect::Iec2);
  EXPECT_EQ(foreignWordIn(broken, 2, vocabulary_), "`REF_TO` is of edition 3");
}

TEST_F(Edition, WhatNoGrammarHas) {
  const auto none = [&](const std::string& text, const std::string& what) {
    EXPECT_EQ(foreign(3, text), what + " not of the standard") << text;
  };
  none(program("", "VAR CONSTANT n : INT := 3; END_VAR VAR s : STRING[n]; END_VAR", "s := 'a';"),
       "a length of a string that is not a number is");
  none("NAMESPACE A VAR_GLOBAL x : INT; END_VAR END_NAMESPACE\n" + program("", "", ";"),
       "VAR_GLOBAL of a namespace is");
  none(
      program("", "VAR_OUTPUT q : BOOL; END_VAR", "q := TRUE;") +
          "CONFIGURATION c\nVAR_GLOBAL lamp : BOOL; END_VAR\nRESOURCE r ON PLC\nTASK t(INTERVAL := T#10ms, PRIORITY := "
          "1);\nPROGRAM i WITH t : p(NOT q => lamp);\nEND_RESOURCE\nEND_CONFIGURATION\n",
      "NOT of a connection of a program is");
  none(program("", "VAR x : INT; END_VAR", "LD x\nMAX( 2\nADD 1\n)\nST x"), "a deferred function is");
  none(program("", "VAR x : INT; END_VAR", "LD x\nLIMIT(1, 2, 3)\nST x"), "a list of operands in parentheses is");
}

TEST_F(Edition, CodesOfCharactersAreOfEdition4) {
  const std::string text = program("", "VAR c : CHAR; n : USINT; END_VAR", "n := CHAR_TO_USINT(c);");
  EXPECT_EQ(foreign(3, text), "`CHAR_TO_USINT` is of edition 4");
  EXPECT_EQ(foreign(3, program("", "VAR c : CHAR; s : STRING; END_VAR", "s := CHAR_TO_STRING(c);")), kAll);
}

}  // namespace
}  // namespace rung::conformance
