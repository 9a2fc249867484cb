// SPDX-License-Identifier: Apache-2.0
// Projects cut at every byte, with bytes, ids, attributes and elements changed at random: each is read and parsed, each
// message has a location in the file, and nothing crashes or hangs. The seed is fixed; RUNG_SPOILT_SEED and
// RUNG_SPOILT_COUNT try others.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "tests/unit/import/imported_file.h"

namespace rung::importer::plcopen {
namespace {

const std::string kFiles[] = {
    R"(<?xml version="1.0"?><project xmlns="http://www.plcopen.org/xml/tc6_0201" xmlns:h="http://www.w3.org/1999/xhtml"><types>
<dataTypes><dataType name="E"><baseType><enum><values><value name="a" value="1"/><value name="b"/></values></enum></baseType></dataType>
<dataType name="S"><baseType><struct><variable name="x"><type><array><dimension lower="0" upper="3"/><baseType><INT/></baseType></array></type><initialValue><arrayValue><value repetitionValue="2"><simpleValue value="1"/></value></arrayValue></initialValue></variable></struct></baseType><initialValue><structValue><value member="x"><simpleValue value="[1]"/></value></structValue></initialValue></dataType></dataTypes>
<pous><pou name="P" pouType="program"><interface><localVars retain="true"><variable name="n" address="%MW0"><type><string length="4"/></type><initialValue><simpleValue value="ab"/></initialValue><documentation><h:p>text</h:p></documentation></variable></localVars></interface>
<body><ST><h:p><![CDATA[n := n + 1;]]></h:p></ST></body><addData><data name="x/plcopenxml/method"><Method name="M"><interface><returnType><INT/></returnType></interface><body><IL><h:p>LD 1</h:p><h:p>ST M</h:p></IL></body></Method></data><data name="x/plcopenxml/property"><Property name="Q"><interface><returnType><INT/></returnType></interface><GetAccessor><interface/><body><ST>Q := 1;</ST></body></GetAccessor></Property></data></addData></pou></pous></types>
<instances><configurations><configuration name="C"><resource name="R"><task name="t" interval="PT0.05S" priority="1"><pouInstance name="p" typeName="P"/><addData><data name="x/plcopenxml/tasksettings"><TaskSettings KindOfTask="Cyclic" Interval="5" IntervalUnit="ms"><Watchdog Enabled="true" Time="3"/></TaskSettings></data></addData></task><globalVars><variable name="g"><type><BOOL/></type></variable></globalVars></resource><accessVars><accessVariable alias="a" instancePathAndName="R.g" direction="readWrite"><type><BOOL/></type></accessVariable></accessVars></configuration></configurations></instances></project>)",
    R"(<project xmlns="http://www.plcopen.org/xml/tc6_0200"><types><pous><pou name="F" pouType="functionBlock"><interface><inputVars><variable name="x"><type><BOOL/></type></variable></inputVars></interface>
<actions><action name="A"><body><ST>x := x;</ST></body></action></actions><transitions><transition name="T"><body><ST>x</ST></body></transition></transitions><body><SFC>
<step localId="1" name="A" initialStep="true"><addData><data name="x/sfc/element"><attributes><attribute guid="a6b08bd8">A</attribute></attributes></data></addData></step>
<actionBlock localId="2"><connectionPointIn><connection refLocalId="1"/></connectionPointIn><action localId="0" qualifier="L" duration="T#1s"><reference name="A"/></action><action qualifier="N"><inline><ST>;</ST></inline></action></actionBlock>
<selectionDivergence localId="3"><connectionPointIn><connection refLocalId="1"/></connectionPointIn></selectionDivergence>
<transition localId="4"><connectionPointIn><connection refLocalId="3"/></connectionPointIn><condition><reference name="T"/></condition></transition>
<inVariable localId="5"><expression>NOT x</expression></inVariable>
<transition localId="6"><connectionPointIn><connection refLocalId="3"/></connectionPointIn><condition negated="true"><connectionPointIn><connection refLocalId="5"/></connectionPointIn></condition></transition>
<simultaneousDivergence localId="7"><connectionPointIn><connection refLocalId="6"/></connectionPointIn></simultaneousDivergence>
<step localId="8" name="B"><connectionPointIn><connection refLocalId="7"/></connectionPointIn></step><step localId="9" name="C"><connectionPointIn><connection refLocalId="7"/></connectionPointIn></step>
<transition localId="10"><connectionPointIn><connection refLocalId="9"/></connectionPointIn><condition><inline><ST>x;</ST></inline></condition></transition>
<simultaneousConvergence localId="11"><connectionPointIn><connection refLocalId="8"/></connectionPointIn><connectionPointIn><connection refLocalId="10"/></connectionPointIn></simultaneousConvergence>
<transition localId="12"><connectionPointIn><connection refLocalId="11"/></connectionPointIn><condition><inline><ST>T := x; y();</ST></inline></condition></transition>
<jumpStep localId="13" targetName="A"><connectionPointIn><connection refLocalId="12"/></connectionPointIn></jumpStep><jumpStep localId="14" targetName="A"><connectionPointIn><connection refLocalId="4"/></connectionPointIn></jumpStep>
</SFC></body></pou></pous></types></project>)",
};

void readAndParse(const std::string& text) {
  ImportedFile reading("p.xml", text, FileKind::Plcopen);
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

TEST(SpoiltProject, CutAtEveryByte) {
  for (const std::string& file : kFiles)
    for (size_t n = 0; n <= file.size(); ++n) {
      ImportedFile reading("p.xml", file.substr(0, n), FileKind::Plcopen);
      EXPECT_EQ(reading.diagnostics.errorCount(), n == file.size() ? 0u : 1u) << file.substr(0, n);
    }
}

class Spoiler {
 public:
  explicit Spoiler(uint32_t seed) : random_(seed) {}

  std::string run() {
    std::string text = kFiles[random_() % std::size(kFiles)];
    for (uint32_t changes = 1 + random_() % 4; changes > 0; --changes) {
      switch (random_() % 6) {
        case 0: byte(text); break;
        case 1: quoted(text, false); break;
        case 2: quoted(text, true); break;
        default: element(text); break;
      }
      if (text.empty()) text = " ";
    }
    return text;
  }

 private:
  size_t at(const std::string& text) { return random_() % text.size(); }

  void byte(std::string& text) {
    static constexpr std::string_view kLikely = "<>&;/'\"![]()*@_ \n=:?#";
    const size_t where = at(text);
    switch (random_() % 3) {
      case 0: text[where] = static_cast<char>(random_()); break;
      case 1: text[where] = kLikely[random_() % kLikely.size()]; break;
      default: text.erase(where, 1 + random_() % 20);
    }
  }

  // Replaces the value of an attribute by that of another, or by nothing.
  void quoted(std::string& text, bool empty) {
    const size_t open = text.find('"', at(text));
    const size_t close = open == std::string::npos ? open : text.find('"', open + 1);
    const size_t other = text.find('"', at(text));
    const size_t other_end = other == std::string::npos ? other : text.find('"', other + 1);
    if (close == std::string::npos || other_end == std::string::npos) return;
    const std::string value = empty ? "" : text.substr(other + 1, other_end - other - 1);
    if (value.find('<') == std::string::npos) text.replace(open + 1, close - open - 1, value);
  }

  // Removes an element without content, or repeats it somewhere else.
  void element(std::string& text) {
    const size_t close = text.find("/>", at(text));
    const size_t open = close == std::string::npos ? close : text.rfind('<', close);
    if (open == std::string::npos) return;
    const std::string copy = text.substr(open, close + 2 - open);
    if (random_() % 2 == 0) text.erase(open, copy.size());
    const size_t where = text.find('<', at(text));
    if (where != std::string::npos && random_() % 2 == 0) text.insert(where, copy);
  }

  std::mt19937 random_;
};

TEST(SpoiltProject, ElementsAndBytesChanged) {
  const char* seed = std::getenv("RUNG_SPOILT_SEED");
  const char* count = std::getenv("RUNG_SPOILT_COUNT");
  Spoiler spoiler(seed != nullptr ? static_cast<uint32_t>(std::atoi(seed)) : 1);
  for (int i = count != nullptr ? std::atoi(count) : 3000; i > 0; --i) readAndParse(spoiler.run());
}

}  // namespace
}  // namespace rung::importer::plcopen
