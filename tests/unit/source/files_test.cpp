// SPDX-License-Identifier: Apache-2.0
// Locations: lines, columns in characters, tokens, several files, sources with invalid bytes.
#include "frontend/source/files.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

Loc at(const Sources& sources, FileId file, size_t offset) {
  return {sources.begin(file).offset + static_cast<uint32_t>(offset)};
}

TEST(Files, LocationsOfThreeKindsOfLineEnd) {
  Sources sources;
  const FileId file = sources.add("a.st", "ab\ncd\r\nef\rgh");
  EXPECT_EQ(sources.location(at(sources, file, 0)).column, 1u);
  EXPECT_EQ(sources.location(at(sources, file, 4)).line, 2u);
  EXPECT_EQ(sources.location(at(sources, file, 7)).line, 3u);
  EXPECT_EQ(sources.location(at(sources, file, 10)).line, 4u);
  EXPECT_EQ(sources.location(at(sources, file, 11)).column, 2u);
  EXPECT_EQ(sources.line(file, 2), "cd");
  EXPECT_EQ(sources.line(file, 3), "ef");
  EXPECT_EQ(sources.line(file, 4), "gh");
  EXPECT_EQ(sources.line(file, 5), "");
}

TEST(Files, ColumnsCountCharacters) {
  Sources sources;
  const std::string text = "x := 'Müßli'; y\nü";
  const FileId file = sources.add("a.st", text);
  EXPECT_EQ(sources.location(at(sources, file, text.find("; y"))).column, 13u);
  EXPECT_EQ(sources.location(at(sources, file, text.find("y\n"))).column, 15u);
  EXPECT_EQ(sources.location(at(sources, file, text.find("üßli"))).line, 1u);
  EXPECT_EQ(sources.location(at(sources, file, 0)).column, 1u);
  EXPECT_EQ(sources.location(at(sources, file, text.size())).column, 2u);
}

TEST(Files, ByteOrderMarkIsDropped) {
  Sources sources;
  const FileId file = sources.add("a.st", "\xef\xbb\xbfPROGRAM");
  EXPECT_EQ(sources.sourceText(file), "PROGRAM");
  EXPECT_EQ(sources.sourceText(file).data()[7], '\0');
}

TEST(Files, EveryLocationHasOneFile) {
  Sources sources;
  const FileId a = sources.add("a.st", "aaa"), empty = sources.add("e.st", ""), b = sources.add("b.st", "bbb");
  EXPECT_EQ(sources.fileOf(at(sources, a, 3)), a);  // its end
  EXPECT_EQ(sources.fileOf(sources.begin(empty)), empty);
  EXPECT_EQ(sources.fileOf(at(sources, b, 0)), b);
  EXPECT_EQ(sources.fileOf(at(sources, a, 0)), a);
  EXPECT_FALSE(sources.fileOf(Loc{}));
  EXPECT_FALSE(sources.fileOf(at(sources, b, 4)));
  EXPECT_EQ(sources.location(Loc{}).line, 0u);
  EXPECT_EQ(sources.path(FileId{}), "");
  EXPECT_EQ(sources.fileCount(), 3u);
}

TEST(Files, Tokens) {
  Sources sources;
  const auto token = [&](const char* text) {
    return std::string(sources.tokenAt(sources.begin(sources.add("t.st", text))));
  };
  EXPECT_EQ(token("counter := 1"), "counter");
  EXPECT_EQ(token(":= 1"), ":=");
  EXPECT_EQ(token("16#FF_FF;"), "16#FF_FF");
  EXPECT_EQ(token("1.5e-3+x"), "1.5e-3");
  EXPECT_EQ(token("1..5"), "1");
  EXPECT_EQ(token("T#1h30m-x"), "T#1h30m");
  EXPECT_EQ(token("T#-1.5s;"), "T#-1.5s");
  EXPECT_EQ(token("DT#2026-11-21-12:30:00;"), "DT#2026-11-21-12:30:00");
  EXPECT_EQ(token("INT#5-x"), "INT#5");
  EXPECT_EQ(token("'it$'s' "), "'it$'s'");
  EXPECT_EQ(token("'open\n'"), "'");
  EXPECT_EQ(token("%IX0.3;"), "%IX0.3");
  EXPECT_EQ(token("\n"), "");
  EXPECT_EQ(token(""), "");
}

TEST(Files, ReadingSaysWhatTheSystemSaid) {
  EXPECT_EQ(readFile("/no/such/file").error, "No such file or directory");
  EXPECT_EQ(readFile("/").error, "Is a directory");
  EXPECT_EQ(readFile("/dev/null").error, "");
}

TEST(Files, InvalidUtf8) {
  EXPECT_EQ(findInvalidUtf8("plain ASCII, and longer than eight bytes"), std::string_view::npos);
  EXPECT_EQ(findInvalidUtf8("Grüße €𝄞"), std::string_view::npos);
  EXPECT_EQ(findInvalidUtf8("Gr\xfc\xdf"), 2u);
  EXPECT_EQ(findInvalidUtf8("\xc0\x80"), 0u);          // overlong
  EXPECT_EQ(findInvalidUtf8("ab\xed\xa0\x80"), 2u);    // surrogate
  EXPECT_EQ(findInvalidUtf8("\xf4\x90\x80\x80"), 0u);  // beyond U+10FFFF
  EXPECT_EQ(findInvalidUtf8("12345678\xe2\x82"), 8u);  // cut
}

TEST(Files, SourceMappedTextHasTheLocationsOfItsParts) {
  Sources sources;
  const FileId a = sources.add("a.xml", "one\n  two"), b = sources.add("b.xml", "three");
  const FileId created = sources.addSourceMapped(
      "a.xml", "two END three",
      {{0, at(sources, a, 6), true}, {3, at(sources, a, 9), false}, {8, at(sources, b, 0), true}});
  EXPECT_EQ(sources.location(at(sources, created, 0)).line, 2u);
  EXPECT_EQ(sources.location(at(sources, created, 2)).column, 5u);
  EXPECT_EQ(sources.location(at(sources, created, 5)).column, 6u);  // END follows `two`
  EXPECT_EQ(sources.lineNumber(at(sources, created, 5)), 2u);
  EXPECT_EQ(sources.location(at(sources, created, 9)).file, b);
  EXPECT_EQ(sources.location(at(sources, created, 9)).column, 2u);
  EXPECT_EQ(sources.fileOf(at(sources, created, 9)), created);
  EXPECT_EQ(sources.originalLocation(at(sources, a, 3)), at(sources, a, 3));
  EXPECT_EQ(sources.tokenAt(at(sources, created, 8)), "three");
}

TEST(Files, Utf16BecomesUtf8) {
  std::string little("\xff\xfe\x41\x00\xe4\x00\x3d\xd8\x00\xde", 10), big("\xfe\xff\x00\x41\x20\xac", 6);
  EXPECT_TRUE(decodeUtf16(little));
  EXPECT_EQ(little, "Aä😀");
  EXPECT_TRUE(decodeUtf16(big));
  EXPECT_EQ(big, "A€");
  std::string plain = "A", odd("\xff\xfe\x41", 3), half("\xff\xfe\x3d\xd8", 4), alone("\xff\xfe\x00\xde\x41\x00", 6);
  EXPECT_TRUE(decodeUtf16(plain));
  EXPECT_EQ(plain, "A");
  EXPECT_FALSE(decodeUtf16(odd));
  EXPECT_FALSE(decodeUtf16(half));
  EXPECT_FALSE(decodeUtf16(alone));
}

}  // namespace
}  // namespace rung
