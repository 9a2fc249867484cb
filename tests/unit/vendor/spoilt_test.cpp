// Vendors' files cut at every byte, and with bytes changed at random: each is read and parsed, and nothing crashes or
// hangs. The seed is fixed; RUNG_SPOILT_SEED and RUNG_SPOILT_COUNT try others.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "frontend/text/parse.h"
#include "tests/unit/vendor/read_helper.h"

namespace rung::vendor {
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
};

void readAndParse(const std::string& text) {
  Reading reading("spoilt", text);
  Project project;
  if (formatOf(text) == Format::TwinCatProject)
    (void)readProject(reading.sources, reading.file, reading.diagnostics, project);
  Names names;
  Tree tree;
  if (reading.program)
    text::parseFile(tree, names, reading.sources, reading.program, text::Standard::Codesys, reading.diagnostics);
  reading.diagnostics.sort();
  for (const Diagnostic& diagnostic : reading.diagnostics.all()) {
    if (!diagnostic.loc) continue;
    const Place place = reading.sources.place(diagnostic.loc);
    EXPECT_EQ(place.file, reading.file) << diagnostic.message << "\n" << text;
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
}  // namespace rung::vendor
