// SPDX-License-Identifier: Apache-2.0
// Diagnostics for people and tools: source with underlines, JSON, SARIF; hostile bytes; cut lines; limits.
#include "frontend/source/render.h"
#include "sema/diagnostics.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

class Render : public testing::Test {
 protected:
  Report unknown(const std::string& text, size_t offset, std::string_view name) {
    const Loc loc = sources.begin(sources.add("a.st", text));
    return diagnostics.report(diag::UnknownName, {loc.offset + static_cast<uint32_t>(offset)}, {name});
  }
  std::string as(DiagnosticFormat format) { return render(diagnostics, sources, {format, false, nullptr}); }
  std::string text() { return as(DiagnosticFormat::Text); }

  Sources sources;
  Diagnostics diagnostics{sources};
};

TEST_F(Render, LineCaretAndNote) {
  unknown("\n\tstrat := TRUE;\n", 2, "strat").didYouMean("start");
  EXPECT_EQ(text(),
            "a.st:2:2: error[E0401]: `strat` is not declared\n"
            " 2 | \tstrat := TRUE;\n"
            "   | \t^~~~~\n"
            "a.st:2:2: note: did you mean `start`?\n");
}

TEST_F(Render, NoteWithALocationShowsIt) {
  const Loc loc = sources.begin(sources.add("a.st", "first\nsecond\n"));
  diagnostics.report(diag::UnknownName, {loc.offset + 6}, {"second"}).declaredHere(loc);
  EXPECT_EQ(text(),
            "a.st:2:1: error[E0401]: `second` is not declared\n"
            " 2 | second\n"
            "   | ^~~~~~\n"
            "a.st:1:1: note: declared here\n"
            " 1 | first\n"
            "   | ^~~~~\n");
}

TEST_F(Render, EndOfFileHasACaret) {
  unknown("IF a", 4, "x");
  EXPECT_EQ(text(),
            "a.st:1:5: error[E0401]: `x` is not declared\n"
            " 1 | IF a\n"
            "   |     ^\n");
}

TEST_F(Render, WholeFile) {
  diagnostics.report(diag::UnknownName, {}, {"x"}).path("missing.st");
  EXPECT_EQ(text(), "missing.st: error[E0401]: `x` is not declared\n");
}

TEST_F(Render, ElementOfADiagram) {
  unknown("<contact/>", 0, "x").element("POU main, network 3, contact \"start\", localId 12");
  EXPECT_NE(text().find("a.st:1:1: note: in POU main, network 3, contact \"start\", localId 12\n"), std::string::npos);
}

TEST_F(Render, ControlBytesAreEscaped) {
  unknown(std::string("\033[2J\0\xff x", 8), 7, "\033[31mx\xe2\x80\xae");
  EXPECT_EQ(text(),
            "a.st:1:8: error[E0401]: `\\x1b[31mx\\xe2\\x80\\xae` is not declared\n"
            " 1 | \\x1b[2J\\x00\\xff x\n"
            "   |                 ^\n");
}

TEST_F(Render, UnderlinesBelowWideSources) {
  unknown("s := 'Müßli'; y := 1;", std::string("s := 'Müßli'; ").size(), "y");
  EXPECT_EQ(text(),
            "a.st:1:15: error[E0401]: `y` is not declared\n"
            " 1 | s := 'Müßli'; y := 1;\n"
            "   |               ^\n");
}

TEST_F(Render, LongLinesAreCut) {
  unknown(std::string(500000, 'a') + " bad " + std::string(500000, 'b'), 500001, "bad");
  const std::string out = text();
  EXPECT_LT(out.size(), 700u);
  EXPECT_NE(out.find("aaa bad bbb"), std::string::npos);
  const size_t source = out.find(" 1 | ..."), mark = out.find("   | ");
  EXPECT_EQ(out.find("bad", source) - source, out.find('^') - mark);
  EXPECT_NE(out.find("b...\n"), std::string::npos);
}

TEST_F(Render, SaysHowManyAreNotShown) {
  diagnostics.max_errors = 1;
  const Loc loc = sources.begin(sources.add("a.st", "x y z"));
  for (uint32_t i = 0; i < 5; i += 2) diagnostics.report(diag::UnknownName, {loc.offset + i}, {"x"});
  EXPECT_NE(text().find("\n2 more errors not shown (--max-errors)\n"), std::string::npos);
}

TEST_F(Render, Color) {
  unknown("x", 0, "x");
  const std::string out = render(diagnostics, sources, {DiagnosticFormat::Text, true, nullptr});
  EXPECT_NE(out.find("\033[1;31merror[E0401]: \033[0m"), std::string::npos);
}

TEST_F(Render, Json) {
  unknown("\n  strat \"x\"", 3, "strat").didYouMean("start");
  EXPECT_EQ(
      as(DiagnosticFormat::Json),
      "{\"diagnostics\":[\n"
      "{\"code\":\"E0401\",\"severity\":\"error\",\"message\":\"`strat` is not declared\",\"path\":\"a.st\",\"line\":2,"
      "\"column\":3,\"endColumn\":8,\"notes\":[{\"message\":\"did you mean `start`?\",\"path\":\"a.st\",\"line\":2,"
      "\"column\":3,\"endColumn\":8}],\"fixes\":[{\"title\":\"Write `start`\",\"preferred\":false,\"edits\":["
      "{\"path\":\"a.st\",\"line\":2,\"column\":3,\"endLine\":2,\"endColumn\":8,\"text\":\"start\"}]}]}\n"
      "],\"errors\":1,\"warnings\":0,\"notShown\":0}\n");
}

TEST_F(Render, JsonOfNothing) {
  EXPECT_EQ(as(DiagnosticFormat::Json), "{\"diagnostics\":[\n],\"errors\":0,\"warnings\":0,\"notShown\":0}\n");
}

TEST_F(Render, Sarif) {
  unknown("strat", 0, "strat");
  const std::string out = as(DiagnosticFormat::Sarif);
  EXPECT_NE(out.find("\"version\":\"2.1.0\""), std::string::npos);
  EXPECT_NE(out.find("{\"id\":\"E0401\",\"name\":\"UnknownName\""), std::string::npos);
  EXPECT_NE(out.find("\"help\":{\"text\":"), std::string::npos);
  EXPECT_NE(out.find("\"region\":{\"startLine\":1,\"startColumn\":1,\"endColumn\":6}"), std::string::npos);
}

TEST(JsonQuote, EscapesWhatItMust) {
  EXPECT_EQ(jsonQuote("a\"b\\c\n\x01ü"), "\"a\\\"b\\\\c\\n\\u0001ü\"");
  EXPECT_EQ(jsonQuote("\xff\xc3"), "\"\\ufffd\\ufffd\"");
}

}  // namespace
}  // namespace rung
