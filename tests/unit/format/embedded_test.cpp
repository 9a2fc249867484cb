// SPDX-License-Identifier: Apache-2.0
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

TEST(Embedded, PrefixesAndDeclarationsAsText) {
  EXPECT_EQ(format("<ppx:ST><x:p a='>'>a:=1;</x:p></ppx:ST>"), "<ppx:ST><x:p a='>'>a := 1;</x:p></ppx:ST>");
  EXPECT_EQ(format("<b:textDeclaration>\n<b:content>program p\nvar a:int; end_var\n</b:content></b:textDeclaration>"),
            "<b:textDeclaration>\n<b:content>PROGRAM p\nVAR a : INT; END_VAR\n</b:content></b:textDeclaration>");
  EXPECT_EQ(format("<InterfaceAsPlainText><xhtml>program p</xhtml></InterfaceAsPlainText>"),
            "<InterfaceAsPlainText><xhtml>PROGRAM p</xhtml></InterfaceAsPlainText>");
}

TEST(Embedded, LineEndsAsEntities) {
  EXPECT_EQ(format("<ST>if a then&#13;\nb:=1;&#13;\nend_if</ST>"), "<ST>IF a THEN&#13;\n  b := 1;&#13;\nEND_IF</ST>");
  EXPECT_EQ(format("<ST>if a then&#xD;\nb:=1;&#xD;\nend_if</ST>"), "<ST>IF a THEN&#xD;\n  b := 1;&#xD;\nEND_IF</ST>");
}

TEST(Embedded, ALineInEachParagraph) {
  EXPECT_EQ(format("<ST><x:p>if a&lt;1 then</x:p>\n<x:p>b:='&amp;';</x:p><x:p/><x:p> end_if</x:p>\n</ST>"),
            "<ST><x:p>IF a &lt; 1 THEN</x:p>\n<x:p>  b := '&amp;';</x:p><x:p/><x:p>END_IF</x:p>\n</ST>");
  EXPECT_EQ(format("<ST>a:=1;<br/><![CDATA[b:=a<2;]]></ST>"), "<ST>a := 1;<br/><![CDATA[b := a < 2;]]></ST>");
  EXPECT_EQ(format("<IL><p>ld a</p><p> st b</p></IL>"), "<IL><p>  LD      a</p><p>  ST      b</p></IL>");
}

TEST(Embedded, TextsThatAreNotLinesStay) {
  const std::string wide =
      "call(first_argument := 1000000, second_argument := 2000000, third := 3000000, fourth := 4000000, fifth:=5);";
  for (const std::string& source :
       {std::string("<ST>a:=1;<b>b</b>:=2;</ST>"), std::string("<ST><p>a:=1;\nb:=2;</p><p>c:=3;</p></ST>"),
        "<ST><p>" + wide + wide + "</p><p>a:=1;</p></ST>", std::string("<ST>a:=1;<!-- > x:=1; --> b:=2;</ST>"),
        std::string("<a><![CDATA[<ST>a:=1;</ST>]]></a>")})
    EXPECT_EQ(format(source), source);
}

TEST(Embedded, InstructionLists) {
  EXPECT_EQ(format("<IL><p><![CDATA[\nld a\nst b\n]]></p></IL>"),
            "<IL><p><![CDATA[\n  LD      a\n  ST      b\n]]></p></IL>");
  EXPECT_EQ(format("<IL>\n ld   a\n st b\n</IL>"), "<IL>\n  LD      a\n  ST      b\n</IL>");
}

TEST(Embedded, ListsOnOneLineStay) {
  for (const char* source : {"<IL><p>ld a st b</p></IL>", "<IL/>", "<IL></IL>"}) EXPECT_EQ(format(source), source);
}

TEST(Embedded, OtherTextStays) {
  for (const char* source : {"<!-- <ST>a:=1;</ST> -->", "<ST2>a:=1;</ST2>", "<STATE>a:=1;</STATE>", "<ST>a:=1;", "",
                             "<", "</", "<ST", "<ST>", "<ST><b>", "<ST a='>", "<ST><![CDATA[a:=1;", "<ST><b/></ST>"})
    EXPECT_EQ(format(source), source);
}

}  // namespace
}  // namespace rung::format
