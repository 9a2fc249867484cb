// SPDX-License-Identifier: Apache-2.0
// Vendors' files are recognized by their content, and become one ST source in one order.
#include <gtest/gtest.h>

#include "frontend/import/pairs.h"
#include "frontend/import/twincat/twincat.h"
#include "tests/unit/import/imported_file.h"

namespace rung::importer {
namespace {

FileKind kindOf(std::string_view text) { return importer::kindOf("file", text); }

TEST(Formats, KnownByContent) {
  EXPECT_EQ(kindOf("\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- <x> --><TcPlcObject Version=\"1\">"), FileKind::TwinCat);
  EXPECT_EQ(kindOf("<Project xmlns=\"http://schemas.microsoft.com/developer/msbuild/2003\">"), FileKind::PlcProject);
  EXPECT_EQ(kindOf("<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\">"), FileKind::Plcopen);
  EXPECT_EQ(kindOf("\r\n\r\n(* @NESTEDCOMMENTS := 'Yes' *)\r\n"), FileKind::Codesys2);
  EXPECT_EQ(kindOf("(* by hand *)\n(* @PATH := '' *)"), FileKind::Codesys2);
  EXPECT_EQ(kindOf("(*@PROPERTIES_EX@\nTYPE: POU\n*)"), FileKind::Multiprog);
  EXPECT_EQ(kindOf("(* @author me *) PROGRAM p"), FileKind::St);
  for (const char* text : {"", " ", "(*", "(* @", "p"}) EXPECT_EQ(kindOf(text), FileKind::Unknown);
  for (const char* text : {"<", "<!--", "<?"}) EXPECT_EQ(kindOf(text), FileKind::Xml);
}

TEST(Pairs, Names) {
  for (const char* path : {"a/Motor.pou", "a/motor.ST", "a/Motor_body.st", "a/Motor.impl.st", "a/MOTOR-decl.txt",
                           "a/Motor/declaration.st", "a/Motor/implementation.st"})
    EXPECT_EQ(pairName(path), "A/MOTOR") << path;
  EXPECT_EQ(pairName("a/Antibody.st"), "A/ANTIBODY");
  EXPECT_EQ(pairName("body.st"), "");
  EXPECT_EQ(pairName("a.b/c"), "A.B/C");
}

TEST(TwinCat, MembersStandBetweenDeclarationAndBody) {
  const ImportedFile reading("FB.TcPOU", R"(<TcPlcObject><POU Name="FB">
<Declaration><![CDATA[FUNCTION_BLOCK FB]]></Declaration>
<Implementation><ST><![CDATA[run();]]></ST></Implementation>
<Folder Name="f" />
<Method Name="Start"><Declaration><![CDATA[METHOD Start : BOOL]]></Declaration>
  <Implementation><ST><![CDATA[Start := TRUE;]]></ST></Implementation></Method>
<Property Name="Speed"><Declaration><![CDATA[PROPERTY Speed : INT]]></Declaration>
  <Get Name="Get"><Declaration><![CDATA[PROTECTED VAR END_VAR]]></Declaration><Implementation><ST>Speed := 1;</ST></Implementation></Get>
  <Set Name="Set"><Declaration></Declaration><Implementation><ST><![CDATA[]]></ST></Implementation></Set></Property>
<Action Name="Stop"><Implementation><ST><![CDATA[x := 1;]]></ST></Implementation></Action>
</POU></TcPlcObject>)");
  EXPECT_EQ(reading.text(),
            "FUNCTION_BLOCK FB\n"
            "METHOD Start : BOOL\nStart := TRUE;\nEND_METHOD\n"
            "PROPERTY Speed : INT\nGET PROTECTED VAR END_VAR\n\nSpeed := 1;\nEND_GET\nSET \n\n\nEND_SET\nEND_PROPERTY\n"
            "ACTION Stop :\nx := 1;\nEND_ACTION\n"
            "run();\nEND_FUNCTION_BLOCK\n");
  EXPECT_EQ(reading.errors(), "");
}

TEST(TwinCat, InterfaceTypeAndGlobals) {
  EXPECT_EQ(ImportedFile("I.TcIO",
                         "<TcPlcObject><Itf Name='I'><Declaration>INTERFACE I</Declaration><Method Name='M'>"
                         "<Declaration>METHOD M</Declaration></Method></Itf></TcPlcObject>")
                .text(),
            "INTERFACE I\nMETHOD M\nEND_METHOD\nEND_INTERFACE\n");
  EXPECT_EQ(ImportedFile("G.TcGVL",
                         "<TcPlcObject><GVL Name='G'><Declaration>VAR_GLOBAL END_VAR</Declaration></GVL></TcPlcObject>")
                .text(),
            "VAR_GLOBAL END_VAR\n");
  EXPECT_EQ(ImportedFile("V.TcVIS", "<TcPlcObject><Visu Name='V'>x</Visu></TcPlcObject>").text(), "");
}

TEST(TwinCat, DrawnBodiesAreNamedAndDeclarationsCount) {
  const ImportedFile reading(
      "P.TcPOU",
      "<TcPlcObject><POU Name='P'><Declaration>PROGRAM P</Declaration>\n"
      "<Implementation><LADDER><XmlArchive>x := 1;</XmlArchive></LADDER></Implementation>\n"
      "<Action Name='A'><Implementation>\n<StateChart/></Implementation></Action></POU></TcPlcObject>");
  EXPECT_EQ(reading.text(), "PROGRAM P\nACTION A :\nEND_ACTION\nEND_PROGRAM\n");
  EXPECT_EQ(reading.errors(),
            "4:2 the body of `P.A` is a state chart, which this version of Rung does not read\n"
            "2:18 the body of `P` is drawn in networks (FBD or LD), which this version of Rung does not read\n");
}

TEST(TwinCat, TaskBecomesConfiguration) {
  EXPECT_EQ(ImportedFile("T.TcTTO",
                         "<TcPlcObject><Task Name='Fast'><CycleTime>1000</CycleTime><Priority>7</Priority>"
                         "<PouCall><Name>A</Name></PouCall><PouCall><Name>B</Name></PouCall></Task></TcPlcObject>")
                .text(),
            "CONFIGURATION Fast_configuration\nRESOURCE Fast_resource ON PLC\nTASK Fast(INTERVAL := T#1000us, PRIORITY "
            ":= 7);\n"
            "PROGRAM A WITH Fast : A;\nPROGRAM B WITH Fast : B;\nEND_RESOURCE\nEND_CONFIGURATION\n");
}

TEST(TwinCat, ProjectListsFilesAndLibraries) {
  Sources sources;
  Diagnostics diagnostics(sources);
  const FileId file = sources.add("a.plcproj", R"(<Project><ItemGroup><Compile Include="POUs\A%20b.TcPOU" />
<Compile Include="V.TcVIS" /><Compile Include="Off.tcpou"><ExcludeFromBuild>true</ExcludeFromBuild></Compile>
<Folder Include="POUs" /></ItemGroup><PlaceholderReference Include="Tc2_Standard"><Namespace>Std</Namespace></PlaceholderReference>
<LibraryReference Include="Util, 3.5.1.0, System" /><LibraryReference Include="util,newest,System" /></Project>)");
  twincat::Project project;
  ASSERT_TRUE(twincat::readProject(sources, file, diagnostics, project));
  ASSERT_EQ(project.files.size(), 1u);
  EXPECT_EQ(project.files[0].path, "POUs/A b.TcPOU");
  EXPECT_EQ(sources.location(project.files[0].loc).column, 39u);
  ASSERT_EQ(project.libraries.size(), 2u);
  EXPECT_EQ(project.libraries[0].name, "Tc2_Standard");
  EXPECT_EQ(project.libraries[0].space, "Std");
  EXPECT_EQ(project.libraries[1].space, "");
  EXPECT_EQ(project.libraries[1].name, "Util");
}

TEST(Codesys2, TextThatNeedsNothingIsParsedAsItStands) {
  const ImportedFile reading(
      "a.EXP",
      "(* @PATH := '' *)\nPROGRAM P\nVAR END_VAR\n(* @END_DECLARATION := '0' *)\n;\nEND_PROGRAM\n"
      "ACTION A:\nx := 1;\nEND_ACTION\n");
  EXPECT_EQ(reading.program, reading.file);
}

TEST(Codesys2, FunctionBlockInOneWord) {
  const ImportedFile reading("a.EXP", "(* @PATH := '' *)\nFUNCTIONBLOCK f\nVAR END_VAR\nEND_FUNCTION_BLOCK\n");
  EXPECT_EQ(reading.text(), "(* @PATH := '' *)\nFUNCTION_BLOCK f\nVAR END_VAR\nEND_FUNCTION_BLOCK\n");
  EXPECT_EQ(reading.locationOf("FUNCTION_BLOCK f"), "2:1");
  EXPECT_EQ(reading.locationOf(" f"), "2:14");
}

TEST(Codesys2, DrawnBodiesAndForeignObjectsAreLeftOut) {
  const ImportedFile reading(
      "a.EXP",
      "(* @PATH := '' *)\nPROGRAM P\nVAR x : INT; END_VAR\n_FBD_BODY\n_NETWORKS : 1\n_COMMENT\n"
      "'it's\n_END_COMMENT\nEND_PROGRAM\n\n(* @NESTEDCOMMENTS := 'Yes' *)\nVISUALISATION v\nPROGRAM no\n"
      "(* @NESTEDCOMMENTS := 'Yes' *)\nTYPE t : INT; END_TYPE\n");
  EXPECT_EQ(reading.text(),
            "(* @PATH := '' *)\nPROGRAM P\nVAR x : INT; END_VAR\nEND_PROGRAM\n\n(* @NESTEDCOMMENTS := 'Yes' *)\n"
            "(* @NESTEDCOMMENTS := 'Yes' *)\nTYPE t : INT; END_TYPE\n");
  EXPECT_EQ(reading.errors(), "4:1 the body of `P` is drawn in FBD, which this version of Rung does not read\n");
}

TEST(Multiprog, DescriptionsAndDrawnSheetsAreLeftOut) {
  const ImportedFile reading(
      "a.ST",
      "(*@PROPERTIES_EX@\n*)\n(*@KEY@:DESCRIPTION*)\nit's (* bare\n(*@KEY@:END_DESCRIPTION*)\n"
      "PROGRAM P\n(*@KEY@: WORKSHEET\nNAME: P1\nIEC_LANGUAGE: LD\n*)\n[1](0,0)\n(*@KEY@: END_WORKSHEET *)\n"
      "END_PROGRAM\n");
  EXPECT_EQ(reading.text(),
            "(*@PROPERTIES_EX@\n*)\n(*@KEY@:DESCRIPTION*)(*@KEY@:END_DESCRIPTION*)\nPROGRAM P\n"
            "(*@KEY@: WORKSHEET\nNAME: P1\nIEC_LANGUAGE: LD\n*)(*@KEY@: END_WORKSHEET *)\nEND_PROGRAM\n");
  EXPECT_EQ(reading.errors(), "9:15 the body of `P1` is drawn in LD, which this version of Rung does not read\n");
}

}  // namespace
}  // namespace rung::importer
