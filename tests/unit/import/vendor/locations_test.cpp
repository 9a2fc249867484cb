// SPDX-License-Identifier: Apache-2.0
// Locations in source-mapped text: the line and column of the file on disk.
#include <gtest/gtest.h>

#include "frontend/import/pairs.h"
#include "tests/unit/import/imported_file.h"

namespace rung::importer {
namespace {

TEST(Places, PartsEntitiesAndAddedKeywords) {
  const ImportedFile reading(
      "P.TcPOU",
      "<TcPlcObject>\n <POU Name=\"P\">\n  <Declaration><![CDATA[PROGRAM P\nVAR x : INT; END_VAR]]></Declaration>\n"
      "  <Implementation><ST>x := ä &lt; 1;\r\n  y;</ST></Implementation>\n </POU>\n</TcPlcObject>");
  EXPECT_EQ(reading.locationOf("PROGRAM"), "3:25");
  EXPECT_EQ(reading.locationOf("x : INT"), "4:5");
  EXPECT_EQ(reading.locationOf("x :="), "5:23");
  EXPECT_EQ(reading.locationOf("< 1"), "5:30");
  EXPECT_EQ(reading.locationOf(" 1;"), "5:34");
  EXPECT_EQ(reading.locationOf("y;"), "6:3");
  EXPECT_EQ(reading.locationOf("END_PROGRAM"), "6:5");  // after the token before it
  EXPECT_EQ(reading.sources.path(reading.program), "P.TcPOU");
}

TEST(Places, PairsOfFiles) {
  Sources sources;
  const FileId a = sources.add("M.pou", "FUNCTION_BLOCK M\n"), b = sources.add("M.st", "\n  x := 1;");
  std::vector<PairCandidate> files = {{"M.pou", a}, {"M.st", b}};
  joinPairs(sources, files);
  EXPECT_FALSE(files[1].file);
  const FileId program = files[0].file;
  EXPECT_EQ(sources.sourceText(program), "FUNCTION_BLOCK M\n\n\n  x := 1;\nEND_FUNCTION_BLOCK");
  const SourceLocation location = sources.location({sources.begin(program).offset + 21});
  EXPECT_EQ(sources.path(location.file), "M.st");
  EXPECT_EQ(location.line, 2u);
  EXPECT_EQ(location.column, 3u);
}

}  // namespace
}  // namespace rung::importer
