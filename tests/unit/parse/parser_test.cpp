// SPDX-License-Identifier: Apache-2.0
// Expressions by dialect, context-dependent keywords, limits, doc comments and pragmas.
#include <gtest/gtest.h>

#include <algorithm>

#include "frontend/source/dialect.h"
#include "tests/unit/parse/parse_helper.h"

namespace rung::text {
namespace {

std::string expression(const std::string& text, Dialect dialect = Dialect::Codesys) {
  const Parsed parsed("PROGRAM p\nx := " + text + ";\nEND_PROGRAM\n", dialect);
  const std::string before = "assign := (name x) ";
  const size_t at = parsed.printed.find(before);
  if (parsed.diagnostics.hasErrors() || at == std::string::npos) return parsed.codes();
  return parsed.printed.substr(at + before.size(), parsed.printed.size() - at - before.size() - 1);
}

TEST(Expressions, Precedence) {
  EXPECT_EQ(expression("a + b * c"), "(binary + (name a) (binary * (name b) (name c)))");
  EXPECT_EQ(expression("a - b - c"), "(binary - (binary - (name a) (name b)) (name c))");
  EXPECT_EQ(expression("a OR b XOR c AND d"),
            "(binary OR (name a) (binary XOR (name b) (binary AND (name c) (name d))))");
  EXPECT_EQ(expression("a < b = c > d"), "(binary = (binary < (name a) (name b)) (binary > (name c) (name d)))");
  EXPECT_EQ(expression("NOT a & b"), "(binary AND (unary NOT (name a)) (name b))");
  EXPECT_EQ(expression("a MOD b / c"), "(binary / (binary MOD (name a) (name b)) (name c))");
  EXPECT_EQ(expression("2 ** 3 ** 2"), "(binary ** (binary ** (literal 2) (literal 3)) (literal 2))");
  EXPECT_EQ(expression("a AND_THEN b OR_ELSE c"), "(binary OR_ELSE (binary AND_THEN (name a) (name b)) (name c))");
}

TEST(Expressions, SignAndPowerByDialect) {
  EXPECT_EQ(expression("-2 ** 2"), "(unary - (binary ** (literal 2) (literal 2)))");
  EXPECT_EQ(expression("-2 ** 2", Dialect::Iec3), "(binary ** (unary - (literal 2)) (literal 2))");
  EXPECT_EQ(statementErrors("x := -2 ** 2;"), "2:6 W0250");
  EXPECT_EQ(statementErrors("x := -2 ** 2;", Dialect::Iec2), "2:6 W0250");
  EXPECT_EQ(statementErrors("x := (-2) ** 2 + -(2 ** 2);"), "");
  EXPECT_EQ(statementErrors("x := a OR b XOR c;"), "2:13 W0251");
  EXPECT_EQ(statementErrors("x := a OR b XOR c;", Dialect::Iec3), "");
  EXPECT_EQ(statementErrors("x := a OR (b XOR c) OR d; x := a XOR b OR c;"), "");
  EXPECT_EQ(expression("2 ** -1"), "(binary ** (literal 2) (unary - (literal 1)))");
}

TEST(Expressions, Places) {
  EXPECT_EQ(expression("a.b[i, j]^.c"), "(member (deref (index (member (name a) b) (name i) (name j))) c)");
  EXPECT_EQ(expression("w.3"), "(bit_access (name w) bit 3)");
  EXPECT_EQ(expression("w.%X3"), "(bit_access (name w) bit 3)");
  EXPECT_EQ(expression("w.%B1"), "(bit_access (name w) byte 1)");
  EXPECT_EQ(expression("Color#Red"), "(typed_name Color#Red)");
  EXPECT_EQ(expression("f(1)(2).q"), "(member (call (call (name f) (literal 1)) (literal 2)) q)");
}

TEST(Expressions, Calls) {
  EXPECT_EQ(expression("f()"), "(call (name f))");
  EXPECT_EQ(expression("f(a, p := b, q => c, NOT r => d)"),
            "(call (name f) (name a) p := (name b) q => (name c) NOT r => (name d))");
  EXPECT_EQ(expression("f(p := , q => )"), "(call (name f) p := open q => open)");
  EXPECT_EQ(statementErrors("f(p := , q => 1);", Dialect::Iec3), "2:3 E0225");
  EXPECT_EQ(statementErrors("f(a, );"), "2:4 W0222");
  EXPECT_EQ(statementErrors("f(a, );", Dialect::Iec3), "2:4 E0222");
  EXPECT_EQ(expression("AND(a, b)"), "(call (name AND) (name a) (name b))");
  EXPECT_EQ(expression("TIME()"), "(call (name TIME))");
}

TEST(Statements, AssignmentForms) {
  EXPECT_EQ(body("a += 1;"), "    assign += (name a) (literal 1)\n");
  EXPECT_EQ(body("a S= b; a R= b; r REF= b;"),
            "    assign S= (name a) (name b)\n    assign R= (name a) (name b)\n    assign REF= (name r) (name b)\n");
  EXPECT_EQ(body("a := b := 0;"), "    assign := (name b) (literal 0)\n    assign := (name a) (name b)\n");
  EXPECT_EQ(statementErrors("a := b := 0;", Dialect::Iec3), "2:8 E0221");
  EXPECT_EQ(body("again: a := 1; JMP again;"), "    label again\n    assign := (name a) (literal 1)\n    jump again\n");
}

TEST(Statements, KeywordsThatAreNotReserved) {
  const Parsed parsed(R"(PROGRAM p
VAR priority, interval, task, on, with, read_only, step, action, at, constant, retain, s, r, ref, resource, class : INT; END_VAR
VAR RETAIN persistent AT %MW0 : INT; END_VAR
priority := interval + task + on + with + read_only + step;
at := constant + retain + s + r + ref;
IF s = 1 OR r = 2 THEN action := 1; END_IF
END_PROGRAM
)");
  EXPECT_EQ(parsed.codes(), "");
}

TEST(Statements, SemicolonBehindEndIsOptional) {
  EXPECT_EQ(statementErrors("IF a THEN b := 1; END_IF FOR i := 1 TO 2 DO ; END_FOR x := 1;", Dialect::Iec3), "");
  EXPECT_EQ(statementErrors("REPEAT a := 1; UNTIL a = 1; END_REPEAT"), "");
}

TEST(Declarations, PousWithoutEnd) {
  EXPECT_EQ(Parsed("PROGRAM a\nx := 1;\nFUNCTION_BLOCK b\nVAR y : INT; END_VAR\n").codes(), "");
  EXPECT_EQ(Parsed("PROGRAM a\nx := 1;\n", Dialect::Iec3).codes(), "2:8 E0210");
}

TEST(Declarations, DocsAndPragmas) {
  Parsed parsed(R"(/// Counts.
/// Second line.
{native} {std 'iec2 iec3'}
FUNCTION_BLOCK Count
VAR_INPUT
  {alias 'R'} RESET : BOOL;  /// clears
  /// counts up
  CU : BOOL;
END_VAR
END_FUNCTION_BLOCK
)");
  EXPECT_EQ(parsed.codes(), "");
  const DeclId pou_id = parsed.tree.list(parsed.tree.files[0].decls)[0];
  const auto& pou = parsed.tree.as<PouDecl>(pou_id);
  EXPECT_EQ(parsed.sources.location(pou.h.doc).line, 1u);
  EXPECT_EQ(parsed.sources.location(pou.h.begin).line, 3u);
  EXPECT_EQ(pou.body_kind, BodyKind::Native);
  ASSERT_EQ(pou.h.pragmas.count, 2u);
  const auto section = parsed.tree.as<SectionDecl>(parsed.tree.list(pou.sections)[0]);
  const auto& reset = parsed.tree.as<VarDecl>(parsed.tree.list(section.vars)[0]);
  EXPECT_EQ(parsed.sources.location(reset.h.doc).line, 6u);
  EXPECT_EQ(parsed.tree.string(parsed.tree.list(reset.h.pragmas)[0].value), "R");
  const auto& cu = parsed.tree.as<VarDecl>(parsed.tree.list(section.vars)[1]);
  EXPECT_EQ(parsed.sources.location(cu.h.doc).line, 7u);
}

TEST(Declarations, OneDeclarationOutOfAFile) {
  Sources sources;
  Diagnostics diagnostics(sources);
  Names names;
  Tree tree;
  const std::string text =
      "PROGRAM a END_PROGRAM {native} FUNCTION f : INT VAR_INPUT x : INT; END_VAR END_FUNCTION PROGRAM b END_PROGRAM";
  const FileId file = sources.add("lib.st", text);
  const FileUnit unit = parseFile(tree, names, sources, file, Dialect::Codesys, diagnostics);
  ASSERT_EQ(unit.decls.count, 3u);
  const PouDecl f = tree.as<PouDecl>(tree.list(unit.decls)[1]);
  const Slice<DeclId> again =
      parseDeclarations(tree, names, sources, f.h.begin, f.h.end, Dialect::Codesys, diagnostics);
  ASSERT_EQ(again.count, 1u);
  const auto& copy = tree.as<PouDecl>(tree.list(again)[0]);
  EXPECT_EQ(copy.name, f.name);
  EXPECT_EQ(copy.body_kind, BodyKind::Native);
  EXPECT_EQ(copy.h.end, f.h.end);
  EXPECT_FALSE(diagnostics.hasErrors());
}

TEST(Declarations, LoneExpression) {
  Sources sources;
  Diagnostics diagnostics(sources);
  Names names;
  Tree tree;
  EXPECT_TRUE(parseExpression(tree, names, sources, sources.add("set", "T#5s"), Dialect::Codesys, diagnostics));
  EXPECT_FALSE(diagnostics.hasErrors());
  EXPECT_FALSE(parseExpression(tree, names, sources, sources.add("set", "5 6"), Dialect::Codesys, diagnostics));
  EXPECT_TRUE(diagnostics.hasErrors());
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

TEST(Limits, DeepInputGivesOneError) {
  EXPECT_EQ(statementErrors(repeated("IF a THEN\n", 1000) + "x := 1;\n" + repeated("END_IF\n", 1000)), "");
  EXPECT_EQ(statementErrors(repeated("IF a THEN\n", 5000) + "x := 1;\n" + repeated("END_IF\n", 5000)), "2002:1 E0220");
  EXPECT_EQ(statementErrors("x := " + repeated("(", 10000) + "1" + repeated(")", 10000) + ";\ny := 1;"),
            "2:1006 E0220");
  EXPECT_EQ(statementErrors("x := " + repeated("NOT ", 10000) + "1;\ny := 1;"), "2:4006 E0220");
  EXPECT_EQ(statementErrors("x := " + repeated("1+", 10000) + "1;\ny := 1;"), "2:4007 E0220");
  EXPECT_EQ(statementErrors("x := " + repeated("f[", 10000) + "1" + repeated("]", 10000) + ";\ny := 1;"),
            "2:2007 E0220");
}

TEST(Limits, ManyErrorsAreAllCounted) {
  const Parsed parsed("PROGRAM p\n" + repeated("x := ;\n", 50000) + "END_PROGRAM\n");
  EXPECT_EQ(parsed.diagnostics.errorCount(), 50000u);
}

TEST(Limits, EveryPrefixOfAProgramEnds) {
  const std::string text = R"(TYPE t : STRUCT a : ARRAY [1..2] OF INT := [2(0)]; END_STRUCT END_TYPE
FUNCTION_BLOCK b VAR_INPUT x AT %IX0.0 : BOOL R_EDGE; END_VAR
CASE a OF 1, 2..3: f(x := 1, y => z); ELSE REPEAT a := -b * 2; UNTIL a END_REPEAT END_CASE
FOR i := 1 TO 5 BY 2 DO p^.q[1].3 := 'x$N'; END_FOR WHILE a DO ; END_WHILE {x 'y'} (* c *)
END_FUNCTION_BLOCK CONFIGURATION c RESOURCE r ON p TASK t(INTERVAL := T#1s); PROGRAM i WITH t : b; END_RESOURCE END_CONFIGURATION)";
  EXPECT_EQ(Parsed(text).codes(), "");
  for (size_t n = 0; n < text.size(); ++n) {
    Parsed prefix(text.substr(0, n));
    EXPECT_LE(prefix.diagnostics.errorCount(), 4u) << text.substr(0, n);
    Parsed suffix(text.substr(n));
    SUCCEED();
  }
}

}  // namespace
}  // namespace rung::text
