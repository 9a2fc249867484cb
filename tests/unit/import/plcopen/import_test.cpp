// SPDX-License-Identifier: Apache-2.0
// PLCopen projects are recognized by their content, and become one ST source whose locations are those of the XML.
#include <gtest/gtest.h>

#include "frontend/import/plcopen/plcopen.h"
#include "tests/unit/import/imported_file.h"

namespace rung::importer::plcopen {
namespace {

constexpr std::string_view kBegin = "<project xmlns='http://www.plcopen.org/xml/tc6_0200'><types>";
constexpr std::string_view kEnd = "</types></project>";

std::string project(std::string_view inner) { return std::string(kBegin) + std::string(inner) + std::string(kEnd); }
std::string textOf(std::string_view inner) { return ImportedFile("p.xml", project(inner)).text(); }

TEST(Plcopen, KnownByContent) {
  EXPECT_TRUE(isPlcopen("<?xml version='1.0'?><!-- <a> -->\n<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\">"));
  EXPECT_TRUE(isPlcopen("<project xmlns='http://www.plcopen.org/xml/tc6.xsd' xmlns:x='y'/>"));
  EXPECT_TRUE(isPlcopen("<ns1:project xmlns:ns1='http://www.plcopen.org/xml/tc6_0200'>"));
  EXPECT_TRUE(isPlcopen("<pou xmlns='http://www.plcopen.org/xml/tc6_0201' name='a'>"));
  EXPECT_FALSE(isPlcopen("<project xmlns='http://maven.apache.org/POM/4.0.0'> www.plcopen.org/xml/tc6"));
  EXPECT_FALSE(isPlcopen("<settings xmlns='http://www.plcopen.org/xml/tc6_0201'>"));
  for (const char* text : {"", "<", "<!--", "<?", "<!", "<project", "project", "<a"}) EXPECT_FALSE(isPlcopen(text));
}

TEST(Plcopen, TypesOfEachKind) {
  const auto type = [](std::string_view inner) {
    std::string text = textOf("<dataType name='T'><baseType>" + std::string(inner) + "</baseType></dataType>");
    return text.substr(9, text.find(";\nEND_TYPE") - 9);
  };
  EXPECT_EQ(type("<LREAL/>"), "LREAL");
  EXPECT_EQ(type("<string length='12'/>"), "STRING[12]");
  EXPECT_EQ(type("<wstring/>"), "WSTRING");
  EXPECT_EQ(type("<derived name='Lib.Thing'/>"), "Lib.Thing");
  EXPECT_EQ(type("<pointer><baseType><derived name='X'/></baseType></pointer>"), "POINTER TO X");
  EXPECT_EQ(
      type("<array><dimension lower='0' upper='N - 1'/><dimension lower='1' upper='2'/><baseType><INT/></baseType>"
           "</array>"),
      "ARRAY [0..N - 1, 1..2] OF INT");
  EXPECT_EQ(
      type("<enum><values><value name='a' value='1'/><value name='b'/></values><baseType><BYTE/></baseType></enum>"),
      "(a := 1, b) BYTE");
  EXPECT_EQ(type("<subrangeUnsigned><range lower='1' upper='9'/><baseType><USINT/></baseType></subrangeUnsigned>"),
            "USINT (1..9)");
  EXPECT_EQ(type("<struct><variable name='x'><type><BOOL/></type></variable></struct>"),
            "STRUCT\nx : BOOL;\nEND_STRUCT");
}

TEST(Plcopen, SectionsAndTheirKeywords) {
  EXPECT_EQ(
      textOf(
          "<pou name='F' pouType='function'><interface><returnType><INT/></returnType>"
          "<inputVars constant='true'><variable name='a' address='%IX0.0'><type><BOOL/></type></variable></inputVars>"
          "<localVars retain='true' persistent='true'/><localVars nonretain='true'/><tempVars/></interface></pou>"),
      "FUNCTION F : INT\nVAR_INPUT CONSTANT\na AT %IX0.0 : BOOL;\nEND_VAR\nVAR RETAIN PERSISTENT\nEND_VAR\n"
      "VAR NON_RETAIN\nEND_VAR\nVAR_TEMP\nEND_VAR\nEND_FUNCTION\n");
}

// CODESYS exports ARRAY[*] as a pointer input; the order of the parameters stays.
TEST(Plcopen, ArraysOfAnyLength) {
  const auto variable = [](std::string_view name, std::string_view attributes) {
    return "<variable name='" + std::string(name) +
           "'><type><pointer><baseType><INT/></baseType></pointer></type>"
           "<addData><data name='http://www.3s-software.com/plcopenxml/attributes' "
           "handleUnknown='implementation'><Attributes>" +
           std::string(attributes) +
           "<Attribute Name='Dimensions' Value='1'/></Attributes></data></addData></variable>";
  };
  const std::string type = "<Attribute Name='variable_length_array' Value='ARRAY[*] OF INT'/>";
  const std::string scope = "<Attribute Name='variable_length_array_original_scope' Value=";
  EXPECT_EQ(textOf("<pou name='F' pouType='functionBlock'><interface><inputVars>"
                   "<variable name='a'><type><INT/></type></variable>" +
                   variable("b", scope + "'Inout'/>" + type) + variable("c", type) +
                   variable("d", scope + "'Input'/>" + type) + "</inputVars></interface></pou>"),
            "FUNCTION_BLOCK F\nVAR_INPUT\na : INT;\nEND_VAR\nVAR_IN_OUT\nb : ARRAY[*] OF INT;\n"
            "c : ARRAY[*] OF INT;\nEND_VAR\nVAR_INPUT\nd : ARRAY[*] OF INT;\nEND_VAR\nEND_FUNCTION_BLOCK\n");
}

// Beremiz writes strings without quotes (TC6 2.01); CODESYS writes expressions.
TEST(Plcopen, StringsWithoutQuotes) {
  const std::string inner =
      "<pou name='P' pouType='program'><interface><localVars><variable name='s'><type><string/></type><initialValue>"
      "<simpleValue value='two words'/></initialValue></variable></localVars></interface></pou>";
  EXPECT_NE(ImportedFile("p.xml", "<project xmlns='http://www.plcopen.org/xml/tc6_0201'>" + inner + "</project>")
                .text()
                .find("s : STRING := 'two words';"),
            std::string::npos);
  EXPECT_NE(textOf(inner).find("s : STRING := two words;"), std::string::npos);
}

TEST(Plcopen, DocumentationCannotEndEarly) {
  const std::string text = textOf(
      "<pou name='P' pouType='program'><interface><localVars><variable "
      "name='a'><type><INT/></type><documentation><p>one\n"
      "*) {x} END_VAR\r\n</p></documentation></variable></localVars></interface></pou>");
  EXPECT_EQ(text, "PROGRAM P\nVAR\n/// one\n/// *) {x} END_VAR\na : INT;\nEND_VAR\nEND_PROGRAM\n");
}

TEST(Plcopen, PlainTextWins) {
  const std::string text = textOf(
      "<pou name='P' pouType='program'><interface><localVars><variable name='lost'><type><INT/></type></variable>"
      "</localVars></interface><body><ST>;</ST></body><addData><data name='x/plcopenxml/interfaceasplaintext'>"
      "<InterfaceAsPlainText><xhtml>PROGRAM P\nVAR_STAT n : INT; "
      "END_VAR</xhtml></InterfaceAsPlainText></data></addData></pou>");
  EXPECT_EQ(text, "PROGRAM P\nVAR_STAT n : INT; END_VAR\n;\nEND_PROGRAM\n");
}

TEST(Plcopen, LocationsAreThoseOfTheXml) {
  const ImportedFile reading(
      "p.xml",
      "<project xmlns='http://www.plcopen.org/xml/tc6_0200'>\n <pou name='P' pouType='program'>\n"
      "  <body><ST><p><![CDATA[one := 1;\n  two := 2;]]></p>three := 1 &lt;\n 2;</ST></body>\n </pou>\n</project>");
  EXPECT_EQ(reading.locationOf("P"), "2:3");  // of PROGRAM
  EXPECT_EQ(reading.locationOf("P\n"), "2:13");
  EXPECT_EQ(reading.locationOf("one"), "3:25");
  EXPECT_EQ(reading.locationOf("two"), "4:3");
  EXPECT_EQ(reading.locationOf("three"), "4:19");
  EXPECT_EQ(reading.locationOf("<"), "4:30");
  EXPECT_EQ(reading.locationOf(" 2;"), "4:9");
  EXPECT_EQ(reading.locationOf("END_PROGRAM"), "6:2");
}

TEST(Plcopen, BodyOfCfcHidesItsPlaceholder) {
  const ImportedFile reading("p.xml", project("<pou name='P' pouType='program'><body><ST><xhtml/></ST><addData><data "
                                              "name='http://www.3s-software.com/plcopenxml/cfc'>"
                                              "<CFC/></data></addData></body></pou>"));
  EXPECT_EQ(reading.errors(), "");
  EXPECT_NE(reading.text().find("{network CFC}"), std::string::npos);
}

TEST(Plcopen, LibrariesOfTheProject) {
  const ImportedFile reading(
      "p.xml", project("<x><Libraries><Library Name='#Standard' Namespace='Std'/><Library Name='Util, 3.5.17.0 "
                       "(System)'/><Library Name='UTIL, *'/>"
                       "<Library Name='#IoStandard' SystemLibrary='true'/></Libraries></x>"));
  ASSERT_EQ(reading.libraries.size(), 2u);
  EXPECT_EQ(reading.libraries[0].name, "Standard");
  EXPECT_EQ(reading.libraries[0].space, "Std");
  EXPECT_EQ(reading.libraries[1].name, "Util");
}

// The task of every visualisation of CODESYS calls VisuElems.Visu_Prg. A block in a task is `program.block`.
TEST(Plcopen, TaskCallsTheProgramOfALibrary) {
  const ImportedFile file(
      "p.xml",
      "<project xmlns='http://www.plcopen.org/xml/tc6_0200'><instances><configurations><configuration name='C'>"
      "<resource name='R'><task name='Visu' interval='PT0.2S' priority='1'><pouInstance name='VisuElems.Visu_Prg' "
      "typeName=''/><pouInstance name='Main' typeName=''/><pouInstance name='Main.slow' typeName=''/></task></resource>"
      "</configuration></configurations></instances></project>");
  EXPECT_EQ(file.errors(),
            "1:192 `VisuElems.Visu_Prg` is the program of a library that is not part of Rung; the task does not call "
            "it\n");
  EXPECT_EQ(file.text(),
            "CONFIGURATION C\nRESOURCE R ON PLC\nTASK Visu(INTERVAL := T#200000000ns, PRIORITY := 1);\n"
            "PROGRAM Main WITH Visu : Main(slow WITH Visu);\nEND_RESOURCE\nEND_CONFIGURATION\n");
}

TEST(Plcopen, ExtensionsAreMentionedOncePerKind) {
  EXPECT_EQ(
      ImportedFile(
          "p.xml",
          "<project xmlns='http://www.plcopen.org/xml/tc6_0200'>\n<addData><data name='urn:a'/><data name='urn:a'/>\n"
          "<data name='urn:b'/><data name='urn:c' handleUnknown='discard'/></addData></project>")
          .errors(),
      "2:22 the extension `urn:a` is not read; its content is ignored\n"
      "3:13 the extension `urn:b` is not read; its content is ignored\n");
}

// Wires that meet and part again at each of many lines would form 2^n paths.
TEST(Plcopen, ChartsWithoutEndAreRefused) {
  std::string chart = "<step localId='0' name='A' initialStep='true'/>";
  const auto wire = [](int from) { return "<connection refLocalId='" + std::to_string(from) + "'/>"; };
  int last = 0, id = 1;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 2; ++k)
      chart += "<selectionDivergence localId='" + std::to_string(id + k) + "'><connectionPointIn>" + wire(last) +
               "</connectionPointIn></selectionDivergence>";
    chart += "<selectionConvergence localId='" + std::to_string(id + 2) + "'><connectionPointIn>" + wire(id) +
             wire(id + 1) + "</connectionPointIn></selectionConvergence>";
    last = id + 2;
    id += 3;
  }
  chart += "<transition localId='" + std::to_string(id) + "'><connectionPointIn>" + wire(last) +
           "</connectionPointIn><condition><inline><ST>TRUE</ST></inline></condition></transition>";
  const ImportedFile reading("p.xml",
                             project("<pou name='P' pouType='program'><body><SFC>" + chart + "</SFC></body></pou>"));
  ASSERT_EQ(reading.diagnostics.all().size(), 1u);
  EXPECT_EQ(reading.diagnostics.all()[0].message, "too many paths through one chart; the limit is 1000000");
}

// Found by corrupted_test: a variable has no inputs, whatever is wired to it.
TEST(Plcopen, VariableWiredToItself) {
  const ImportedFile reading(
      "p.xml",
      project(
          "<pou name='P' pouType='program'><body><SFC><step localId='1' name='A' initialStep='true'/><inVariable "
          "localId='2'>"
          "<connectionPointIn><connection refLocalId='2'/></connectionPointIn><expression>x</expression></inVariable>"
          "<transition localId='3'><connectionPointIn><connection refLocalId='1'/></connectionPointIn><condition>"
          "<connectionPointIn><connection refLocalId='2'/></connectionPointIn></condition></transition>"
          "<jumpStep localId='4' targetName='A'><connectionPointIn><connection "
          "refLocalId='3'/></connectionPointIn></jumpStep>"
          "</SFC></body></pou>"));
  EXPECT_NE(reading.text().find("TRANSITION FROM A TO A := (x)"), std::string::npos) << reading.text();
}

TEST(Plcopen, TypesWithoutEndAreRefused) {
  std::string type;
  for (int i = 0; i < 300; ++i) type += "<pointer><baseType>";
  type += "<INT/>";
  for (int i = 0; i < 300; ++i) type += "</baseType></pointer>";
  const ImportedFile reading("p.xml", project("<dataType name='T'><baseType>" + type + "</baseType></dataType>"));
  ASSERT_EQ(reading.diagnostics.all().size(), 1u);
  EXPECT_EQ(reading.diagnostics.all()[0].message, "too many nested types; the limit is 200");
}

}  // namespace
}  // namespace rung::importer::plcopen
