// Sources inside of XML: they change, the file around them does not.
#include <gtest/gtest.h>

#include "frontend/format/format.h"

namespace rung::format {
namespace {

std::string format(const std::string& source) {
  const std::string once = formattedXml(source, {}, Dialect::Codesys);
  EXPECT_EQ(formattedXml(once, {}, Dialect::Codesys), once) << "a second run changes it";
  return once;
}

TEST(Embedded, StatementsAndDeclarations) {
  EXPECT_EQ(
      format("<POU  Name='x'>\n<Declaration><![CDATA[program p\n]]></Declaration>\n<ST><![CDATA[a:=1;]]></ST></POU>"),
      "<POU  Name='x'>\n<Declaration><![CDATA[PROGRAM p\n]]></Declaration>\n<ST><![CDATA[a := 1;]]></ST></POU>");
}

TEST(Embedded, CharactersStayEscaped) {
  EXPECT_EQ(format("<ST><xhtml>if a&lt;b&amp;c then d:='x'; end_if</xhtml></ST>"),
            "<ST><xhtml>IF a &lt; b &amp; c THEN d := 'x'; END_IF</xhtml></ST>");
  EXPECT_EQ(format("<ST>a&#61;1</ST>"), "<ST>a&#61;1</ST>");
}

TEST(Embedded, InstructionLists) {
  EXPECT_EQ(format("<IL><p><![CDATA[\nld a\nst b\n]]></p></IL>"),
            "<IL><p><![CDATA[\n  LD      a\n  ST      b\n]]></p></IL>");
  EXPECT_EQ(format("<IL>\n ld   a\n st b\n</IL>"), "<IL>\n  LD      a\n  ST      b\n</IL>");
}

TEST(Embedded, ListsInParagraphsOrOnOneLineStay) {
  for (const char* source : {"<IL><p>ld a</p><p>st b</p></IL>", "<IL><p>ld a st b</p></IL>", "<IL/>", "<IL></IL>"})
    EXPECT_EQ(format(source), source);
}

TEST(Embedded, OtherTextStays) {
  for (const char* source :
       {"<!-- <ST>a:=1;</ST> -->", "<ST2>a:=1;</ST2>", "<STATE>a:=1;</STATE>", "<ST>a:=1;", "", "<ST><b/></ST>"})
    EXPECT_EQ(format(source), source);
}

}  // namespace
}  // namespace rung::format
