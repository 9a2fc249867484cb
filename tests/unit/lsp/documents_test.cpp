// SPDX-License-Identifier: Apache-2.0
// Positions and edits, compared with a plain reading of the text.
#include "tools/lsp/documents.h"

#include <gtest/gtest.h>

#include <random>

#include "frontend/source/files.h"

namespace rung::lsp {
namespace {

using protocol::Json;

constexpr std::string_view kText = "a\xc3\xbc\xf0\x9f\x98\x80z\r\n\r\n\rxy\n";  // aü😀z

TEST(Positions, CountUnitsOfTheEncoding) {
  const Positions utf16(kText, Encoding::Utf16), utf8(kText, Encoding::Utf8);
  const uint32_t z = 7;  // after 1 + 2 + 4 bytes
  EXPECT_EQ(utf16.positionOf(z), (Position{0, 4}));
  EXPECT_EQ(utf8.positionOf(z), (Position{0, 7}));
  EXPECT_EQ(utf16.byteOf({0, 4}), z);
  EXPECT_EQ(utf8.byteOf({0, 7}), z);
  EXPECT_EQ(utf16.byteOf({0, 3}), 3u) << "in the middle of a pair: before it";
  EXPECT_EQ(utf8.byteOf({0, 5}), 3u) << "in the middle of a character: before it";
}

TEST(Positions, LinesEndWithEveryLineEnd) {
  const Positions positions(kText, Encoding::Utf16);
  EXPECT_EQ(positions.lineCount(), 5u);
  EXPECT_EQ(positions.byteOf({0, 99}), 8u) << "before the line end";
  EXPECT_EQ(positions.byteOf({3, 1}), kText.size() - 2);
  EXPECT_EQ(positions.byteOf({4, 0}), kText.size());
  EXPECT_EQ(positions.byteOf({7, 3}), kText.size());
  EXPECT_EQ(positions.positionOf(9999), (Position{4, 0}));
  EXPECT_EQ(positions.positionOf(9), (Position{0, 5})) << "between CR and LF";
}

// Each character has a position, and the position leads back to it.
TEST(Positions, LeadBack) {
  std::mt19937 random(5);
  for (int round = 0; round < 500; ++round) {
    std::string text;
    std::vector<uint32_t> begins;
    for (uint32_t i = random() % 30; i > 0; --i) {
      static constexpr uint32_t kCharacters[] = {'a', ' ', '\n', '\r', 0xfc, 0x20ac, 0x1f600, '\t'};
      begins.push_back(static_cast<uint32_t>(text.size()));
      appendUtf8(text, kCharacters[random() % std::size(kCharacters)]);
    }
    for (const Encoding encoding : {Encoding::Utf8, Encoding::Utf16}) {
      const Positions positions(text, encoding);
      for (const uint32_t begin : begins) {
        const bool is_inside_line_end = begin > 0 && text[begin] == '\n' && text[begin - 1] == '\r';
        if (is_inside_line_end) continue;
        EXPECT_EQ(positions.byteOf(positions.positionOf(begin)), begin) << text;
      }
    }
  }
}

Json change(uint32_t line, uint32_t from, uint32_t end_line, uint32_t to, const char* text) {
  return {{"range", Json{{"start", Json{{"line", line}, {"character", from}}},
                         {"end", Json{{"line", end_line}, {"character", to}}}}},
          {"text", text}};
}

TEST(Documents, ApplyChangesOneAfterTheOther) {
  Documents documents;
  documents.open("/a", {"file:///a", "one\ntwo\n", 1});
  EXPECT_TRUE(documents.change("/a", 2, Json::Array{change(0, 0, 0, 3, "\xf0\x9f\x98\x80"), change(0, 2, 1, 0, "!")},
                               Encoding::Utf16));
  EXPECT_EQ(documents.find("/a")->text, "\xf0\x9f\x98\x80!two\n");
  EXPECT_EQ(documents.find("/a")->version, 2);
  EXPECT_TRUE(documents.change("/a", 3, Json::Array{Json{{"text", "all"}}}, Encoding::Utf16));
  EXPECT_EQ(documents.find("/a")->text, "all");
  EXPECT_FALSE(documents.change("/b", 1, Json::Array{}, Encoding::Utf16));
  EXPECT_TRUE(documents.change("/a", 4, Json::Array{change(9, 0, 0, 1, "x")}, Encoding::Utf16)) << "end before start";
  EXPECT_EQ(documents.find("/a")->text, "allx");
}

}  // namespace
}  // namespace rung::lsp
