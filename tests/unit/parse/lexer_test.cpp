// SPDX-License-Identifier: Apache-2.0
// Every form of token, comment and pragma, and the diagnostics for invalid source.
#include "frontend/parse/lexer.h"
#include "frontend/source/dialect.h"

#include <gtest/gtest.h>

#include "frontend/source/text.h"
#include "tests/unit/parse/parse_helper.h"

namespace rung::text {
namespace {

struct Lexed {
  explicit Lexed(const std::string& source, Dialect dialect = Dialect::Codesys) : diagnostics(sources) {
    const FileId file = sources.add("test.st", source);
    lex(stream, names, sources, file, 0, static_cast<uint32_t>(sources.sourceText(file).size()), dialect, diagnostics);
    for (const Token& t : stream.tokens) {
      if (t.kind == Tok::End) break;
      if (!words.empty()) words += ' ';
      words += spelling(t.kind);
    }
    for (const Diagnostic& d : diagnostics.all())
      codes += std::string(codes.empty() ? "" : " ") + diagInfo(d.diag).code;
  }
  Sources sources;
  Diagnostics diagnostics;
  Names names;
  TokenStream stream;
  std::string words, codes;
};

TEST(Lexer, EveryWordIsFoundInAnyCase) {
  for (uint32_t k = static_cast<uint32_t>(Tok::And); k < kTokCount; ++k) {
    std::string word = spelling(static_cast<Tok>(k));
    EXPECT_EQ(Lexed(word).stream.tokens[0].kind, static_cast<Tok>(k)) << word;
    for (char& c : word) c = foldedCharacter(c);
    EXPECT_EQ(Lexed(word).stream.tokens[0].kind, static_cast<Tok>(k)) << word;
    EXPECT_EQ(Lexed(word + "x").stream.tokens[0].kind, Tok::Ident) << word;
  }
}

TEST(Lexer, EveryOperator) {
  for (auto k = static_cast<uint32_t>(Tok::Semicolon); k < static_cast<uint32_t>(Tok::And); ++k)
    EXPECT_EQ(Lexed(std::string("a ") + spelling(static_cast<Tok>(k)) + " b").stream.tokens[1].kind,
              static_cast<Tok>(k));
}

TEST(Lexer, NumbersAndRanges) {
  EXPECT_EQ(Lexed("1..5").words, "a number .. a number");
  EXPECT_EQ(Lexed("1.5e-3 16#FF 2#1010_0101 1e6 12_000").words, "a number a number a number a number a number");
  EXPECT_EQ(Lexed("x.3.y").words, "a name . a number . a name");
  EXPECT_EQ(Lexed("INT#-5").words, "INT # - a number");
  EXPECT_EQ(Lexed("T#1d2h_30m1.5s TIME#-5ms LTIME#1us").words, "a duration a duration a duration");
  EXPECT_EQ(Lexed("D#2026-12-31-1 TOD#12:30:00.5 DT#2026-12-31-12:00").words,
            "a date - a number a time of day a date and time");
  EXPECT_EQ(Lexed("%IX0.0 %QW* x.%X3 %MD12;").words, "an address an address a name . an address an address ;");
}

TEST(Lexer, CommentsNestByDialect) {
  EXPECT_EQ(Lexed("a (* x (* y *) z *) b").words, "a name a name");
  EXPECT_EQ(Lexed("a (* x (* y *) z *) b").codes, "");
  EXPECT_EQ(Lexed("a (* x (* y *) z *) b", Dialect::Iec2).codes, "E0114");
  EXPECT_EQ(Lexed("a (* x (* y (* z *) *) (* v *) *) b", Dialect::Iec2).codes, "E0114");
  EXPECT_EQ(Lexed("a (* x (* y (* z *) *) (* v *) *) b", Dialect::Iec2).words, "a name a name");
  EXPECT_EQ(Lexed("a /* x /* y */ z */ b").words, "a name a name");
  EXPECT_EQ(Lexed("a /* x /* y */ z */ b", Dialect::Iec2).codes, "E0114");
  EXPECT_EQ(Lexed("a // x (* y\nb /* z */ c").words, "a name a name a name");
  EXPECT_EQ(Lexed("a (*).*) b").words, "a name a name");
  EXPECT_EQ(Lexed("a (* open").codes, "E0110");
  EXPECT_EQ(Lexed("(***)(**)a/***/b").words, "a name a name");
}

TEST(Lexer, StringsEndOnTheirLine) {
  EXPECT_EQ(Lexed("'a$'b' \"c$\"d\" ''").words, "a string a string a string");
  EXPECT_EQ(Lexed("'open\nx").codes, "E0111");
  EXPECT_EQ(Lexed("'open").codes, "E0111");
  EXPECT_EQ(Lexed("'open$").codes, "E0111");
}

TEST(Lexer, PragmasSpeak) {
  const Lexed lexed("{info 'a'} {WARNING: \"b\"} {error 'c'} {x := 256, y := '}'} z");
  EXPECT_EQ(lexed.codes, "I0133 W0133 E0133");
  EXPECT_EQ(lexed.words, "a name");
  EXPECT_EQ(lexed.stream.pragmas.size(), 4u);
  EXPECT_EQ(Lexed("{open\nx").codes, "E0115");
}

TEST(Lexer, StrayBytesGiveOneErrorEach) {
  EXPECT_EQ(Lexed("a ? b").codes, "E0112");
  EXPECT_EQ(Lexed("gr\xC3\xB6\xC3\x9F"
                  "e := 1")
                .codes,
            "E0113");
  EXPECT_EQ(Lexed("}").codes, "E0117");
  EXPECT_EQ(Lexed(std::string("a\0b", 3)).codes, "E0104");
}

TEST(Lexer, UnderscoresInNames) {
  EXPECT_EQ(Lexed("a__b c_", Dialect::Iec3).codes, "E0116 E0116");
  EXPECT_EQ(Lexed("a__b __XWORD").codes, "W0116");
  EXPECT_EQ(Lexed("_a a_b", Dialect::Iec3).codes, "");
}

}  // namespace
}  // namespace rung::text
