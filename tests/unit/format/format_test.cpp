// The formatter: a source in, the same source in one style out, and the same again from that.
#include "frontend/format/format.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rung::format {
namespace {

std::string format(const std::string& source, const Style& style = {}, const Bodies& bodies = {},
                   LineRange range = {}) {
  const std::string once = formatted(source, bodies, style, Dialect::Codesys, range);
  const bool is_whole = bodies.il.empty() && bodies.kept.empty() && range.last == UINT32_MAX;
  if (is_whole) {
    EXPECT_EQ(formatted(once, bodies, style, Dialect::Codesys), once) << "a second run changes it";
  }
  return once;
}

// Without white space, in one case: what formatting may not change.
std::string tokens(std::string text) {
  text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
             text.end());
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
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

TEST(Format, NetworksStayAsTheyAre) {
  const std::string source = "PROGRAM p\n{LD}\n   in1   in2\n--| |---( )\n{END_LD}\nEND_PROGRAM\n";
  Bodies bodies;
  const size_t begin = source.find("   in1"), end = source.find("{END_LD}");
  bodies.kept = {{static_cast<uint32_t>(begin), static_cast<uint32_t>(end)}};
  const std::string result = format(source, {}, bodies);
  EXPECT_NE(result.find("   in1   in2\n--| |---( )\n"), std::string::npos) << result;
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

}  // namespace
}  // namespace rung::format
