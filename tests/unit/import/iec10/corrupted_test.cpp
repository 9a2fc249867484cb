// SPDX-License-Identifier: Apache-2.0
// Files of IEC 61131-10 cut at every byte, and with bytes changed at random: each is read and parsed, nothing crashes
// or hangs, and every location is in the file. The seed is fixed.
#include <gtest/gtest.h>

#include <random>

#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "tests/unit/import/imported_file.h"

namespace rung::importer::iec10 {
namespace {

const std::string kFile =
    R"(<?xml version="1.0"?><p:Project xmlns:p="www.iec.ch/public/TC65SC65BWG7TF10" xmlns:xsi="x"><p:Types><p:GlobalNamespace>
<p:NamespaceDecl name="N"><p:DataTypeDecl name="T"><p:UserDefinedTypeSpec xsi:type="p:StructTypeSpec"><p:Member name="a"><p:Type><p:InstantlyDefinedType xsi:type="ArrayTypeSpec"><p:BaseType><p:TypeName>INT</p:TypeName></p:BaseType>
<p:DimensionSpec><p:IndexRange lower="1" upper="3"/></p:DimensionSpec></p:InstantlyDefinedType></p:Type><p:InitialValue><p:ArrayValue><p:Value repetitionValue="2"><p:SimpleValue value="7"/></p:Value></p:ArrayValue></p:InitialValue></p:Member></p:UserDefinedTypeSpec></p:DataTypeDecl></p:NamespaceDecl>
<p:DataTypeDecl name="E"><p:UserDefinedTypeSpec xsi:type="EnumTypeWithNamedValueSpec"><p:Enumerator name="A" value="1"/><p:BaseType>INT</p:BaseType></p:UserDefinedTypeSpec></p:DataTypeDecl>
<p:FunctionBlock name="F"><p:Extends><p:TypeName>G</p:TypeName></p:Extends><p:Method name="M" accessSpecifier="private"><p:ResultType><p:TypeName>INT</p:TypeName></p:ResultType><p:MainBody><p:BodyContent xsi:type="ST"><p:ST><![CDATA[M := 1;]]></p:ST></p:BodyContent></p:MainBody></p:Method></p:FunctionBlock>
<p:Program name="P"><p:Vars accessSpecifier="private"><p:Variable name="x"><p:Type><p:TypeName>N\T</p:TypeName></p:Type><p:Address address="%IX0.0"/></p:Variable></p:Vars><p:MainBody>
<p:BodyContent xsi:type="LD"><p:Rung evaluationOrder="1" label="l"><p:LdObject xsi:type="LeftPowerRail"><p:ConnectionPointOut connectionPointOutId="1"/></p:LdObject>
<p:LdObject xsi:type="Contact" operand="a" negated="true" edge="rising"><p:RelPosition x="1.5" y="2"/><p:ConnectionPointIn><p:Connection refConnectionPointOutId="1"/></p:ConnectionPointIn><p:ConnectionPointOut connectionPointOutId="2"/></p:LdObject>
<p:LdObject xsi:type="Coil" operand="b" latch="set"><p:ConnectionPointIn><p:Connection refConnectionPointOutId="2"/></p:ConnectionPointIn></p:LdObject></p:Rung></p:BodyContent>
<p:BodyContent xsi:type="FBD"><p:Network><p:FbdObject xsi:type="Block" typeName="TON" instanceName="t"><p:AddData><p:Data name="d"><ExecutionControl><En><p:ConnectionPointIn><p:Connection refConnectionPointOutId="5"/></p:ConnectionPointIn></En>
<Eno><p:ConnectionPointOut connectionPointOutId="6"/></Eno></ExecutionControl><EvaluationPriority priorityInNetwork="0"/></p:Data></p:AddData><p:InputVariables><p:InputVariable parameterName="IN"><p:ConnectionPointIn/></p:InputVariable></p:InputVariables>
<p:OutputVariables><p:OutputVariable parameterName="" negated="true"><p:ConnectionPointOut connectionPointOutId="7"/></p:OutputVariable></p:OutputVariables></p:FbdObject><p:FbdObject xsi:type="DataSource" identifier="1 &lt; 2"><p:ConnectionPointOut connectionPointOutId="5"/></p:FbdObject>
<p:CommonObject xsi:type="Connector" label="a b"><p:ConnectionPointIn><p:Connection refConnectionPointOutId="7"/></p:ConnectionPointIn></p:CommonObject><p:FbdObject xsi:type="CfcJump" targetLabel="l"/></p:Network></p:BodyContent></p:MainBody></p:Program>
</p:GlobalNamespace></p:Types><p:Instances><p:Configuration name="C"><p:Resource name="R"><p:GlobalVars retain="true"/><p:Task name="T" interval="PT0.02S"/><p:ProgramInstance name="I" typeName="P" associatedTaskName="T"/></p:Resource></p:Configuration></p:Instances></p:Project>)";

uint32_t readAndParse(const std::string& text) {
  ImportedFile read("spoilt", text, FileKind::Iec10);
  Names names;
  Tree tree;
  const uint32_t errors = read.diagnostics.errorCount();
  if (read.program) text::parseFile(tree, names, read.sources, read.program, Dialect::Codesys, read.diagnostics);
  read.diagnostics.sort();
  for (const Diagnostic& diagnostic : read.diagnostics.all()) {
    if (!diagnostic.loc) continue;
    EXPECT_EQ(read.sources.location(diagnostic.loc).file, read.file) << diagnostic.message << "\n" << text;
  }
  return errors;
}

TEST(Spoilt, WholeIsRead) { EXPECT_EQ(readAndParse(kFile), 0u); }

TEST(Spoilt, CutAtEveryByteIsOneError) {
  for (size_t n = 1; n < kFile.size(); ++n) EXPECT_EQ(readAndParse(kFile.substr(0, n)), 1u) << n;
}

TEST(Spoilt, BytesChanged) {
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    std::string text = kFile;
    for (int c = 0; c < 3; ++c) text[random() % text.size()] = static_cast<char>(" <>\"/=a1&;"[random() % 10]);
    readAndParse(text);
  }
}

}  // namespace
}  // namespace rung::importer::iec10
