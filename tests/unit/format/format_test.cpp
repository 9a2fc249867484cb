// SPDX-License-Identifier: Apache-2.0
// The formatter: a source in, the same source in one style out, and the same again from that.
#include "frontend/format/format.h"
#include "frontend/source/text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rung::format {
namespace {

std::string format(const std::string& source, const Style& style = {}, const Bodies& bodies = {},
                   LineRange range = {}) {
  const std::string once = formatted(source, bodies, style, Dialect::Codesys, range);
  const bool is_whole = bodies.il.empty() && range.last == UINT32_MAX;
  if (is_whole) {
    EXPECT_EQ(formatted(once, bodies, style, Dialect::Codesys), once) << "a second run changes it";
  }
  return once;
}

// Without white space, in one case: what formatting may not change.
std::string tokens(std::string text) {
  text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
             text.end());
  return upper(text);
}

TEST(Format, KeywordsBlanksAndLevels) {
  EXPECT_EQ(
      format("program p\nvar\na:int;\nend_var\nif a<1 then\na:=a+1;\nelse\na:=-1;\nend_if\nend_program\n"),
      "PROGRAM p\nVAR\n  a : INT;\nEND_VAR\nIF a < 1 THEN\n  a := a + 1;\nELSE\n  a := -1;\nEND_IF\nEND_PROGRAM\n");
}

TEST(Format, EveryTokenCommentAndPragmaStays) {
  const std::string source =
      "{attribute 'x'}\nfunction_block B (* two\nlines *)\nvar_input a,b:real:=1.0e3; end_var // end\n"
      "case a of 1,2..3: b:=0; (* one *) else ; end_case\nwhile not(a>b) do exit; end_while;;\nend_function_block\n";
  EXPECT_EQ(tokens(format(source)), tokens(source));
}

TEST(Format, TypesAndCommentsShareAColumn) {
  EXPECT_EQ(format("VAR\na : INT; // one\nlonger : BOOL; // two\n\nz : INT;\nEND_VAR\n"),
            "VAR\n  a      : INT;   // one\n  longer : BOOL;  // two\n\n  z : INT;\nEND_VAR\n");
  Style style;
  style.align = false;
  EXPECT_EQ(format("VAR\na : INT;\nlonger : BOOL;\nEND_VAR\n", style), "VAR\n  a : INT;\n  longer : BOOL;\nEND_VAR\n");
}

TEST(Format, TheCaseOfKeywords) {
  Style style;
  style.keywords = KeywordCase::Lower;
  EXPECT_EQ(format("IF TRUE THEN x := INT#3; END_IF\n", style), "if true then x := int#3; end_if\n");
  style.keywords = KeywordCase::Keep;
  EXPECT_EQ(format("If tRue Then x := 1; End_if\n", style), "If tRue Then x := 1; End_if\n");
}

TEST(Format, BlankLinesAndIndentation) {
  Style style;
  style.indent = 4;
  style.blank_lines = 0;
  EXPECT_EQ(format("IF a THEN\n\n\n\nb := 1;\nEND_IF\n", style), "IF a THEN\n    b := 1;\nEND_IF\n");
  style.blank_lines = 2;
  EXPECT_EQ(format("a := 1;\n\n\n\n\nb := 1;\n", style), "a := 1;\n\n\nb := 1;\n");
}

TEST(Format, LongLinesAreBrokenWithinTheWidth) {
  Style style;
  style.width = 30;
  const std::string result = format("result := first_operand AND second_operand AND third_operand;\n", style);
  EXPECT_EQ(tokens(result), tokens("result := first_operand AND second_operand AND third_operand;"));
  size_t begin = 0;
  for (size_t end = result.find('\n'); end != std::string::npos; begin = end + 1, end = result.find('\n', begin))
    EXPECT_LE(end - begin, 30u) << result;
  style.width = 0;
  EXPECT_EQ(format("result := first_operand AND second_operand AND third_operand;\n", style),
            "result := first_operand AND second_operand AND third_operand;\n");
}

TEST(Format, LongLinesOfStatements) {
  Style style;
  style.width = 30;
  EXPECT_EQ(
      format("CASE n OF\n1: IF first THEN second(a := 1, b := 2); third := 3; END_IF; fourth := 4;\nEND_CASE\n", style),
      "CASE n OF\n  1:\n    IF first THEN\n      second(a := 1, b := 2);\n      third := 3;\n"
      "    END_IF; fourth := 4;\nEND_CASE\n");
}

TEST(Format, LongDeclarations) {
  Style style;
  style.width = 36;
  EXPECT_EQ(format("VAR\na : ARRAY[1..2, 1..3] OF INT := 1, 2, 3,\n4, 5, 6; // six\nb : INT; // one\nEND_VAR\n", style),
            "VAR\n  a : ARRAY[1..2, 1..3] OF INT := 1,\n                                  2,\n"
            "                                  3,\n                                  4,\n"
            "                                  5,\n                                  6;  // six\n"
            "  b : INT;                            // one\nEND_VAR\n");
}

TEST(Format, SeveralDeclarationsOnALongLine) {
  Style style;
  style.width = 36;
  EXPECT_EQ(format("VAR\nlonger : INT;\na : ARRAY[0..1] OF INT := [1000, 2000]; b : INT; END_VAR\n", style),
            "VAR\n  longer : INT;\n  a : ARRAY[0..1] OF INT := [1000,\n                             2000]; b : INT; "
            "END_VAR\n");
}

TEST(Format, OnlyTheseLines) { EXPECT_EQ(format("a:=1;\nb:=2;\nc:=3;\n", {}, {}, {2, 2}), "a:=1;\nb := 2;\nc:=3;\n"); }

TEST(Format, LineEndsOfTheFile) { EXPECT_EQ(format("a:=1;\r\nb:=2;\r\n"), "a := 1;\r\nb := 2;\r\n"); }

TEST(Format, InstructionLists) {
  const std::string source = "ld a\nand( b\nor c\n)\nst y (* out *)\nagain: jmpc again\n";
  Bodies bodies;
  bodies.il = {{0, static_cast<uint32_t>(source.size())}};
  const std::string result = format(source, {}, bodies);
  EXPECT_EQ(result, "  LD      a\n  AND( b\n  OR      c\n  )\n  ST      y  (* out *)\nagain: JMPC    again\n");
  bodies.il = {{0, static_cast<uint32_t>(result.size())}};
  EXPECT_EQ(formatted(result, bodies, {}, Dialect::Codesys), result);
}

TEST(Format, Networks) {
  EXPECT_EQ(
      format(
          "program p\n{network LD}\n// of the rung\nnetwork   1 disabled 'one  two';\n RAIL 1;contact 2(a):=1; // in\n"
          "coil 3 (  b+1 )not   set:=2 or 1( Set );\n\n\nnetwork 2;box 4 and[IN1:=3,in2 not:=2(not),x:=1=>,Out=>];\n"
          "jump 5 do:=4( OUT );\n// end\n{end_network}\nend_program\n"),
      "PROGRAM p\n{network LD}\n// of the rung\nNETWORK 1 DISABLED 'one  two';\n  rail 1; contact 2 (a) := 1;  // in\n"
      "  coil 3 (b + 1) NOT SET := 2 OR 1(Set);\n\nNETWORK 2; box 4 AND [IN1 := 3, in2 NOT := 2(not), x := 1 =>, Out "
      "=>];\n"
      "  jump 5 do := 4(OUT);\n  // end\n{end_network}\nEND_PROGRAM\n");
}

TEST(Format, PartsOfElements) {
  EXPECT_EQ(
      format("{network CFC}\nbox 1 Lib . Pump(p)at -5 ,-7,20,30 order 2[];label 2 at;box 3 'U/D'order 4;\n"
             "connector 4 order AT 1,2:=1;connector 5:=1;coil 6(x)holding rising:=1;input 7'@LAMP';\n{end_network}\n"),
      "{network CFC}\nbox 1 Lib.Pump (p) AT -5, -7, 20, 30 ORDER 2 []; label 2 at; box 3 'U/D' ORDER 4;\n"
      "connector 4 order AT 1, 2 := 1; connector 5 := 1; coil 6 (x) HOLDING RISING := 1; input 7 "
      "'@LAMP';\n{end_network}\n");
}

TEST(Format, StatementsInsideOfNetworks) {
  EXPECT_EQ(
      format(
          "{network FBD}\nexecute 1[EN:=2]{network ST}x:=1;if x>0 then x:=0;end_if{end_network};\n"
          "execute 2{network ST}\nif x>0 then\nx:=0;\nend_if\n{end_network};output 3(y):=1;\n{end_network}\ny:=1;\n"),
      "{network FBD}\nexecute 1 [EN := 2] {network ST} x := 1; IF x > 0 THEN x := 0; END_IF {end_network};\n"
      "execute 2 {network ST}\n  IF x > 0 THEN\n    x := 0;\n  END_IF\n{end_network}; output 3 (y) := "
      "1;\n{end_network}\ny := 1;\n");
}

TEST(Format, LongRowsOfNetworks) {
  Style style;
  style.width = 40;
  EXPECT_EQ(format("{network LD}\nNETWORK 1;\nbox 10 TON (a_long_timer) [IN := 1, PT := 2, Q =>, ET =>];\n"
                   "contact 2 (start) := 1; contact 3 (motor) := 1; coil 4 (q) := 2 OR 3;\n{end_network}\n",
                   style),
            "{network LD}\nNETWORK 1;\n  box 10 TON (a_long_timer)\n      [IN := 1, PT := 2, Q =>, ET =>];\n"
            "  contact 2 (start) := 1;\n  contact 3 (motor) := 1;\n  coil 4 (q) := 2 OR 3;\n{end_network}\n");
  EXPECT_EQ(
      format("{network LD}\ncoil 10 (a_variable_of_a_long_name) := 1 OR 2 OR 3 OR 4;\n{end_network}\n", style),
      "{network LD}\ncoil 10 (a_variable_of_a_long_name) := 1\n                                       OR 2\n"
      "                                       OR 3\n                                       OR 4;\n{end_network}\n");
}

TEST(Format, NothingAndWhatIsNotASource) {
  EXPECT_EQ(format(""), "");
  EXPECT_EQ(format("\n\n"), "\n\n");
  EXPECT_EQ(tokens(format("a := 'open\nb:=1;\n")), "A:='OPENB:=1;");
}

TEST(Format, Ladders) {
  const std::string once =
      formattedLadder("PROGRAM p\nMODULE MAIN\nRUNG  \"r\"\nIN A\n(\nIN B\n)\nOUT  C\nEND_MODULE\n", {});
  EXPECT_EQ(once, "PROGRAM p\nMODULE MAIN\nRUNG \"r\"\n  IN A\n  (\n    IN B\n  )\n  OUT C\nEND_MODULE\n");
  EXPECT_EQ(formattedLadder(once, {}), once);
}

TEST(Format, MessagesHaveATabAfterTheNumber) {
  EXPECT_EQ("5\tdoor  \n\n6\t lid\n7\n", formattedMessages("\n5   door  \n\n\n  6 \t lid\n7\n\n", {}));
  EXPECT_EQ("5\tdoor\n6 lid\n", formattedMessages("5 door\n6 lid", {}, {1, 1}));
  EXPECT_EQ("", formattedMessages("", {}));
}

}  // namespace
}  // namespace rung::format
