// SPDX-License-Identifier: Apache-2.0
// Leaving out parts: lines stay where they are, and lists keep a statement.
#include "tools/conformance/parts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rung::conformance {
namespace {

const std::string kIdle = std::string(kIdleDeclaration) + kIdleStatement;

TEST(Parts, FromTheInnermostOutwards) {
  const std::string text = "PROGRAM p\nVAR a : INT; END_VAR\nIF a = 0 THEN\n  a := 1;\nEND_IF;\nEND_PROGRAM\n";
  const std::vector<Part> parts = partsAround(text, Dialect::Iec3, 4);
  ASSERT_GE(parts.size(), 3u);
  EXPECT_EQ(text.substr(parts[0].begin, parts[0].end - parts[0].begin), "a := 1;");
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end(),
                             [](const Part& a, const Part& b) { return a.end - a.begin < b.end - b.begin; }));
  EXPECT_EQ(text.compare(parts.back().begin, 7, "PROGRAM"), 0);
}

TEST(Parts, AListThatWouldBeEmptyKeepsAStatement) {
  std::string text = "PROGRAM p\nVAR a : INT; END_VAR " + kIdle + "\nIF a = 0 THEN\n  EXIT;\nEND_IF;\nEND_PROGRAM\n";
  const std::vector<Part> parts = partsAround(text, Dialect::Iec3, 4);
  ASSERT_TRUE(parts[0].nested);
  blank(text, parts[0]);
  EXPECT_NE(text.find("THEN\n  suite_idle := TRUE;"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6);
}

TEST(Parts, ABlankedLineKeepsTheIdleStatement) {
  std::string text = "FUNCTION f : INT\n " + kIdle + " f := ;\nEND_FUNCTION\n";
  const size_t begin = text.find('\n') + 1;
  blank(text, {begin, text.find('\n', begin)});
  EXPECT_NE(text.find(kIdle), std::string::npos);
  EXPECT_EQ(text.find("f := ;"), std::string::npos);
}

TEST(Parts, AWholePouGoes) {
  std::string text = "FUNCTION f : INT " + kIdle + " END_FUNCTION\nPROGRAM q\nEND_PROGRAM\n";
  blank(text, {0, text.find('\n')});
  EXPECT_EQ(text.find_first_not_of(' '), text.find('\n'));
}

TEST(Parts, SectionsOfWhichNothingIsLeft) {
  std::string text = "TYPE        END_TYPE\nPROGRAM p\nVAR CONSTANT   END_VAR\nVAR a : INT; END_VAR\nEND_PROGRAM\n";
  blankEmptySections(text);
  EXPECT_EQ(text.find("TYPE"), std::string::npos);
  EXPECT_EQ(text.find("CONSTANT"), std::string::npos);
  EXPECT_NE(text.find("VAR a : INT; END_VAR"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
}

}  // namespace
}  // namespace rung::conformance
