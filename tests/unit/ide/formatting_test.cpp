// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/formatting.h"

#include <gtest/gtest.h>

#include <random>

namespace rung::ide {
namespace {

std::string applied(std::string text, const std::vector<TextEdit>& edits) {
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
    text.replace(edit->range.begin, edit->range.end - edit->range.begin, edit->text);
  return text;
}

TEST(LineEdits, AreTheLinesThatDiffer) {
  EXPECT_TRUE(lineEdits({1}, "a\nb\n", "a\nb\n").empty());
  const std::vector<TextEdit> edits = lineEdits({1}, "a\nb\nc\nd\n", "a\nB\nc\nD\n");
  ASSERT_EQ(edits.size(), 2u);
  EXPECT_EQ(edits[0].range, (FileRange{{1}, 2, 4}));
  EXPECT_EQ(edits[1].text, "D\n");
  EXPECT_EQ(lineEdits({1}, "a\n\n\nb\n", "a\n\nb\n").size(), 1u);
}

TEST(LineEdits, TurnOneTextIntoTheOther) {
  std::mt19937 random(11);
  const auto text = [&] {
    std::string out;
    for (uint32_t i = random() % 8; i > 0; --i) out += random() % 3 == 0 ? "x\n" : random() % 2 == 0 ? "\r\n" : "ab\n";
    return random() % 4 == 0 ? out + "end" : out;
  };
  for (int round = 0; round < 3000; ++round) {
    const std::string before = text(), after = text();
    EXPECT_EQ(applied(before, lineEdits({1}, before, after)), after) << before << "---\n" << after;
  }
}

}  // namespace
}  // namespace rung::ide
