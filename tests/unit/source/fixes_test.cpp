// SPDX-License-Identifier: Apache-2.0
// Where the edits of fixes are in files: ST, text that was put together from pieces of XML, entities, line ends.
#include "frontend/source/fixes.h"

#include <gtest/gtest.h>

#include "sema/diagnostics.h"

namespace rung {
namespace {

class Fixes : public testing::Test {
 protected:
  // Of a parsed text: the bytes from `begin` to `end` become `text`.
  std::vector<FileEdit> editsOf(FileId parsed, uint32_t begin, uint32_t end, std::string text) {
    const uint32_t base = sources.begin(parsed).offset;
    const Diagnostic diagnostic{diag::UnknownName, Severity::Error, {base}, {}, {}, 0, "", {}, {}, 0, {}};
    return fileEdits(sources, diagnostic, {"Change it", {{{base + begin}, {base + end}, std::move(text)}}, true});
  }
  std::string applied(FileId parsed, uint32_t begin, uint32_t end, std::string text) {
    const std::vector<FileEdit> edits = editsOf(parsed, begin, end, std::move(text));
    if (edits.size() != 1) return "none";
    std::string result(sources.original(edits[0].file));
    result.replace(edits[0].begin, edits[0].end - edits[0].begin, edits[0].text);
    return result;
  }
  // A file, and a parsed text with copies of its bytes: each piece is where it begins in both, and whether it is a
  // copy.
  struct Piece {
    uint32_t at, from;
    bool is_copy;
  };
  FileId parsedFrom(const std::string& file, const std::string& parsed, const std::vector<Piece>& pieces) {
    const Loc base = sources.begin(sources.add("a.xml", file));
    std::vector<Segment> segments;
    for (const Piece& piece : pieces) segments.push_back({piece.at, {base.offset + piece.from}, piece.is_copy});
    return sources.addSourceMapped("a.xml", parsed, segments);
  }

  Sources sources;
};

TEST_F(Fixes, InSt) {
  const FileId file = sources.add("a.st", "x = 1\n");
  EXPECT_EQ(applied(file, 2, 3, ":="), "x := 1\n");
  EXPECT_EQ(applied(file, 5, 5, ";"), "x = 1;\n");
  EXPECT_EQ(applied(file, 6, 6, "y\n"), "x = 1\ny\n");
}

TEST_F(Fixes, KeepsTheLineEndsOfTheFile) {
  EXPECT_EQ(applied(sources.add("a.st", "x\r\n"), 1, 1, "\nEND_IF"), "x\r\nEND_IF\r\n");
}

TEST_F(Fixes, WhatRungMadeHasNoPlace) {
  const FileId parsed = parsedFrom("<a>x</a>", "BEGIN x", {{0, 0, false}, {6, 3, true}});
  EXPECT_EQ(applied(parsed, 0, 5, "END"), "none");
  EXPECT_EQ(applied(parsed, 2, 2, "END"), "none");
  EXPECT_EQ(applied(parsed, 4, 7, "END"), "none");
  EXPECT_EQ(applied(parsed, 6, 7, "y"), "<a>y</a>");
  EXPECT_EQ(applied(parsed, 7, 7, ";"), "<a>x;</a>");
}

TEST_F(Fixes, WritesEntitiesInXml) {
  const FileId parsed = parsedFrom("<a b=\"x\">y</a>", "x y", {{0, 6, true}, {1, 0, false}, {2, 9, true}});
  EXPECT_EQ(applied(parsed, 0, 1, "a < \"b\" & c\nd"), "<a b=\"a &lt; &quot;b&quot; &amp; c&#10;d\">y</a>");
  EXPECT_EQ(applied(parsed, 2, 3, "a > \"b\"\nd"), "<a b=\"x\">a &gt; \"b\"\nd</a>");
}

TEST_F(Fixes, ReadsEntitiesInXml) {
  const FileId parsed =
      parsedFrom("<a>p &amp;&lt; q</a>", "p &< q", {{0, 3, true}, {2, 5, false}, {3, 10, false}, {4, 14, true}});
  EXPECT_EQ(applied(parsed, 2, 3, "AND"), "<a>p AND&lt; q</a>");
  EXPECT_EQ(applied(parsed, 2, 4, "<>"), "<a>p &lt;&gt; q</a>");
  EXPECT_EQ(applied(parsed, 3, 3, "x"), "<a>p &amp;x&lt; q</a>");
}

TEST_F(Fixes, CdataIsAsItIs) {
  const FileId parsed = parsedFrom("<a><![CDATA[x]]></a>", "x", {{0, 12, true}});
  EXPECT_EQ(applied(parsed, 1, 1, " < 1"), "<a><![CDATA[x < 1]]></a>");
  EXPECT_EQ(applied(parsed, 1, 1, "]]>"), "none");
}

TEST_F(Fixes, OverlappingEditsAreNone) {
  const FileId file = sources.add("a.st", "abc");
  const uint32_t base = sources.begin(file).offset;
  const Diagnostic diagnostic{diag::UnknownName, Severity::Error, {base}, {}, {}, 0, "", {}, {}, 0, {}};
  const Fix fix{"Change it", {{{base}, {base + 2}, "x"}, {{base + 1}, {base + 3}, "y"}}, true};
  EXPECT_TRUE(fileEdits(sources, diagnostic, fix).empty());
}

// What a diagnostic marks is replaced only where the message names it, which is not so for a whole pragma.
TEST_F(Fixes, TheNameOfTheMessage) {
  Diagnostics diagnostics(sources);
  const FileId file = sources.add("a.st", "{mock 'Levl'}\nlevl#x");
  const uint32_t base = sources.begin(file).offset;
  diagnostics.report(diag::UnknownName, {base}, {"Levl"}).length(13).didYouMean("Level");
  diagnostics.report(diag::UnknownName, {base + 14}, {"levl"}).didYouMean("Level");
  const Diagnostic& whole = diagnostics.all()[0];
  const std::vector<FileEdit> in_pragma = fileEdits(sources, whole, whole.fixes[0]);
  ASSERT_EQ(in_pragma.size(), 1u);
  EXPECT_EQ(in_pragma[0].begin, 7u);
  EXPECT_EQ(in_pragma[0].end, 11u);
  const Diagnostic& name = diagnostics.all()[1];
  const std::vector<FileEdit> before_sign = fileEdits(sources, name, name.fixes[0]);
  ASSERT_EQ(before_sign.size(), 1u);
  EXPECT_EQ(before_sign[0].begin, 14u);
  EXPECT_EQ(before_sign[0].end, 18u);
}

}  // namespace
}  // namespace rung
