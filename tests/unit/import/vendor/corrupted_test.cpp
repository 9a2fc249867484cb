// SPDX-License-Identifier: Apache-2.0
// Vendors' files cut at every byte, and with bytes changed at random: each is read and parsed, and nothing crashes or
// hangs. The seed is fixed; RUNG_SPOILT_SEED and RUNG_SPOILT_COUNT try others.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "frontend/import/twincat/twincat.h"
#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "tests/unit/import/imported_file.h"

namespace rung::importer {
namespace {

const std::string kFiles[] = {
    R"(<?xml version="1.0"?><TcPlcObject Version="1.1"><POU Name="FB"><Declaration><![CDATA[FUNCTION_BLOCK FB
VAR_INPUT a : ARRAY[1..3] OF INT; END_VAR]]></Declaration><Implementation><ST>IF a[1] &lt; 2 THEN a[2] := 1; END_IF</ST></Implementation>
<Method Name="M"><Declaration><![CDATA[METHOD M : INT]]></Declaration><Implementation><ST><![CDATA[M := 1;]]></ST></Implementation></Method>
<Property Name="Q"><Declaration>PROPERTY Q : INT</Declaration><Get><Implementation><ST>Q := 2;</ST></Implementation></Get></Property>
<Action Name="A"><Implementation><CFC><x a="&#65;"/></CFC></Implementation></Action></POU></TcPlcObject>)",
    R"(<TcPlcObject><Task Name="T"><CycleTime>1000</CycleTime><Priority>1</Priority><PouCall><Name>P</Name></PouCall></Task></TcPlcObject>)",
    R"(<Project xmlns="http://schemas.microsoft.com/developer/msbuild/2003"><Compile Include="a%20.TcPOU"><X/></Compile>
<LibraryReference Include="Util, *"/></Project>)",
    "(* @NESTEDCOMMENTS := 'Yes' *)\r\n(* @PATH := '' *)\r\nPROGRAM P\r\nVAR x : ARRAY[1..2] OF INT := 1, 2(3); "
    "END_VAR\r\n"
    "(* @END_DECLARATION := '0' *)\r\n_LD_BODY\r\n_NETWORKS : 1\r\n_COMMENT\r\n''\r\nEND_PROGRAM\r\nACTION A:\r\nx[1] "
    ":= 2;\r\n"
    "END_ACTION\r\n(* @NESTEDCOMMENTS := 'Yes' *)\r\nVISUALISATION v\r\n(* @NESTEDCOMMENTS := 'No' *)\r\nVAR_GLOBAL g "
    ": INT; END_VAR\r\n",
    "(*@PROPERTIES_EX@\nTYPE: POU\n*)\n(*@KEY@:DESCRIPTION*)\ntext\n(*@KEY@:END_DESCRIPTION*)\nFUNCTION "
    "F:INT\nVAR_INPUT x : INT; END_VAR\n"
    "(*@KEY@: WORKSHEET\nNAME: F\nIEC_LANGUAGE: ST\n*)\nF := x;\n(*@KEY@: END_WORKSHEET *)\n(*@KEY@: "
    "WORKSHEET\nIEC_LANGUAGE: FBD\n*)\n"
    "'(*@KEY@: END_WORKSHEET *)\nEND_FUNCTION\n",
    R"(<TcPlcObject><POU Name="P"><Declaration>PROGRAM P VAR a, b : BOOL; t : TON; END_VAR</Declaration><Implementation><NWL><XmlArchive><Data>
<o t="NWLImplementationObject"><v n="DefaultViewMode">"Ld"</v><l2 n="NetworkList" cet="Network"><o><v n="Title">"it's"</v><v n="Label">"l"</v>
<l2 n="NetworkItems"><o t="BoxTreeDemux"><v n="VarId">1</v><o n="Input" t="BoxTreeBox"><v n="BoxType">"AND"</v><o n="OutputItems"><l2 n="OutputItems"><n/></l2></o>
<l2 n="InputItems" cet="BoxTreeOperand"><o><o n="Operand"><v n="Operand">"a"</v><v n="Type">"BOOL"</v></o></o><o><o n="Operand"><v n="Operand">"b"</v><v n="Type">"BOOL"</v>
<o n="Flags"><v n="Flags">17</v></o></o></o></l2><v n="CallType">And</v></o></o><o t="BoxTreeAssign"><o n="RValue" t="BoxTreeParallel"><o n="Input" t="BoxTreeDemux"><v n="VarId">1</v></o>
<l2 n="Trees" cet="BoxTreeOperand"><o><o n="Operand"><v n="Operand">"b &lt; a"</v></o></o><o/></l2></o><o n="OutputItems"><l2 n="OutputItems"><o><v n="Operand">"l"</v><o n="Flags"><v n="Flags">4</v></o></o></l2></o></o>
<o t="BoxTreeBox"><v n="BoxType">"TON"</v><o n="Instance"><v n="Operand">"t"</v></o><l2 n="InputItems"><o t="BoxTreeTerminator"/><n/></l2><o n="InputParam"><l2 n="Names"><v>IN</v></l2></o>
<o n="OutputParam"><l2 n="Names"><v>Q</v></l2></o></o></l2></o></l2></o></Data></XmlArchive></NWL></Implementation></POU></TcPlcObject>)",
    R"(<TcPlcObject><POU Name="P"><Declaration>PROGRAM P VAR a, b : BOOL; t : TON; END_VAR</Declaration><Implementation><CFC><XmlArchive><Data>
<o t="CFCImplementationObject"><o n="Items"><l2 n="InnerList"><o t="CFCInputElement"><o n="Output"><v n="Id">1L</v></o><o n="Text"><v n="Text">"a"</v></o><v n="Bounds">"1, 2, 3, 4"</v></o>
<o t="CFCBoxElement"><o n="Inputs"><l2 n="InnerList" cet="CFCInOutPin"><o><v n="Id">2L</v><v n="Negated">true</v></o></l2></o><o n="Outputs"><l2 n="InnerList"><o><v n="Id">3L</v></o></l2></o>
<o n="Texts"><l2 n="InnerList"><o><v n="Text">"IN"</v></o><o><v n="Text">"TON"</v></o><o><v n="Text">"t"</v></o></l2></o><v n="KindOfCall">FunctionBlock</v></o>
<o t="CFCSourceConnectionMark"><o n="Input"><v n="Id">5L</v></o><o n="Text"><v n="Text">"a b"</v></o></o><o t="CFCSinkConnectionMark"><o n="Output"><v n="Id">6L</v></o><o n="Text"><v n="Text">"a b"</v></o></o>
<o t="CFCOutputElement"><o n="Input"><v n="Id">4L</v><v n="SetReset">Set</v></o><o n="Text"><v n="Text">"b"</v></o></o><o t="CFCConnection"><v n="SourcePinId">1L</v><v n="DestPinId">2L</v></o>
<o t="CFCConnection"><v n="SourcePinId">6L</v><v n="DestPinId">4L</v></o><o t="CFCConnection"><v n="SourcePinId">3L</v><v n="DestPinId">5L</v></o></l2></o></o></Data></XmlArchive></CFC></Implementation></POU></TcPlcObject>)",
    R"(<TcPlcObject><POU Name="P"><Declaration>PROGRAM P VAR a, b : BOOL; END_VAR</Declaration><Implementation><SFC><XmlArchive><Data><o t="SFCImplementationObject">
<o n="Root"><o n="ElementList"><l2 n="InnerList"><o t="SFCStep"><l2 n="Attributes"><o><v n="AttributeId">{38391c6d}</v><o n="Value"><v n="Value">"S"</v></o></o><o><v n="AttributeId">{6844a48e}</v><o n="Value"><v n="Value">"TRUE"</v></o></o></l2></o>
<o t="SFCTransition"><l2 n="Attributes"><o><v n="AttributeId">{38391c6d}</v><o n="Value"><v n="Value">"a"</v></o></o></l2></o><o t="SFCBranch"><o n="ElementList"><l2 n="InnerList" cet="SFCSegment">
<o><o n="ElementList"><l2 n="InnerList"><o t="SFCStep"><l2 n="Attributes"><o><v n="AttributeId">{38391c6d}</v><o n="Value"><v n="Value">"L"</v></o></o></l2></o></l2></o></o>
<o><o n="ElementList"><l2 n="InnerList"><o t="SFCStep"><l2 n="Attributes"><o><v n="AttributeId">{38391c6d}</v><o n="Value"><v n="Value">"R"</v></o></o></l2></o></l2></o></o></l2></o>
<l2 n="Attributes"><o><v n="AttributeId">{23bdaa98}</v><o n="Value"><v n="Value">"TRUE"</v></o></o></l2></o><o t="SFCTransition"><l2 n="Attributes"><o><v n="AttributeId">{38391c6d}</v><o n="Value"><v n="Value">"b"</v></o></o></l2></o>
<o t="SFCJump"><l2 n="Attributes"><o><v n="AttributeId">{38391c6d}</v><o n="Value"><v n="Value">"S"</v></o></o></l2></o></l2></o></o></o></Data></XmlArchive></SFC></Implementation></POU></TcPlcObject>)",
};

void readAndParse(const std::string& text) {
  ImportedFile reading("spoilt", text);
  twincat::Project project;
  if (kindOf("spoilt", text) == FileKind::PlcProject)
    (void)twincat::readProject(reading.sources, reading.file, reading.diagnostics, project);
  Names names;
  Tree tree;
  if (reading.program)
    text::parseFile(tree, names, reading.sources, reading.program, Dialect::Codesys, reading.diagnostics);
  reading.diagnostics.sort();
  for (const Diagnostic& diagnostic : reading.diagnostics.all()) {
    if (!diagnostic.loc) continue;
    const SourceLocation location = reading.sources.location(diagnostic.loc);
    EXPECT_EQ(location.file, reading.file) << diagnostic.message << "\n" << text;
  }
}

TEST(Spoilt, CutAtEveryByte) {
  for (const std::string& file : kFiles)
    for (size_t n = 0; n <= file.size(); ++n) readAndParse(file.substr(0, n));
}

TEST(Spoilt, BytesChanged) {
  const char* seed = std::getenv("RUNG_SPOILT_SEED");
  const char* count = std::getenv("RUNG_SPOILT_COUNT");
  std::mt19937 random(seed != nullptr ? static_cast<uint32_t>(std::atoi(seed)) : 1);
  const int rounds = count != nullptr ? std::atoi(count) : 4000;
  static constexpr std::string_view kLikely = "<>&;/'\"![]()*@_ \n=:?#";
  for (int i = 0; i < rounds; ++i) {
    std::string text = kFiles[random() % std::size(kFiles)];
    for (uint32_t changes = 1 + random() % 4; changes > 0; --changes) {
      const size_t at = random() % text.size();
      switch (random() % 4) {
        case 0: text[at] = static_cast<char>(random()); break;
        case 1: text[at] = kLikely[random() % kLikely.size()]; break;
        case 2: text.erase(at, 1 + random() % 20); break;
        default: text.insert(at, text.substr(random() % text.size(), random() % 40)); break;
      }
      if (text.empty()) text = " ";
    }
    readAndParse(text);
  }
}

}  // namespace
}  // namespace rung::importer
