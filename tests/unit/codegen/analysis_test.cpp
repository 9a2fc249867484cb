// SPDX-License-Identifier: Apache-2.0
// The analyses of a body: IR text in, what each of them found as text out.
#include "codegen/analysis.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/unit/ir/ir_text.h"

namespace rung::codegen {
namespace {

const char* const kLibrary =
    "function @Len native Lib pure sized library { in s: string[80]; result int }\n"
    "function @Mid native Lib pure sized slice library { in s: string[80]; in l: dint; in p: dint; result string[80] "
    "}\n"
    "function @Concat native Lib pure sized library { in a: string[80]; in b: string[80]; result string[80] }\n"
    "function @Plain native Lib pure library { in s: string[80]; result int }\n";

struct Analysed {
  explicit Analysed(const std::string& text) : read(text + kLibrary), facts(read.module, false) {
    EXPECT_TRUE(read.ok) << read.errors();
    body = read.find("B");
    if (body == nullptr) return;
    of.emplace(analyzeBody(read.module, *body, facts));
  }
  const Variables& variables() const { return of->uses.variables; }

  ir::TestModule read;
  Facts facts;
  ir::Body* body = nullptr;
  std::optional<BodyAnalysis> of;
};

// A block @B with these variables and statements.
Analysed analysed(const std::string& variables, const std::string& statements) {
  return Analysed("block @B { " + variables + " }\nbody @B {\n" + statements + "\n}\n");
}

TEST(Uses, LoopsCountMore) {
  const Analysed b = analysed("in a: int; var x: int; var i: int", "x = a\nfor i = 0 to 9 by 1 { x = add int x, a }");
  EXPECT_EQ(b.of->uses.toString(),
            "a weight 5 in loops 4\n"
            "x weight 9 in loops 8 written\n"
            "i weight 5 in loops 4 written\n");
}

TEST(Uses, AddressExposes) {
  const Analysed b = analysed("var x: int; var p: pointer to int", "p = address pointer to int x");
  EXPECT_EQ(b.of->uses.toString(),
            "x weight 1 exposed\n"
            "p weight 1 written\n");
}

TEST(Locals, FieldsThatAreUsedOftenAreCached) {
  const Analysed b = analysed("var x: int; var y: int", "x = add int x, y\nx = add int x, 1");
  EXPECT_EQ(b.of->fields.toString(b.variables()), "x cached\n");
}

TEST(Locals, AcrossCallsOnlyLoopsCount) {
  const std::string variables = "var x: int; var s: string[80]";
  const std::string statements = "x = add int x, 1\nx = add int x, 1\n";
  const Analysed alone = analysed(variables, statements);
  EXPECT_EQ(alone.of->fields.toString(alone.variables()), "x cached\n");
  const Analysed calls = analysed(variables, statements + "s = call @Mid(s, 1, 1)");
  EXPECT_EQ(calls.of->fields.toString(calls.variables()), "");
}

// Variables that may have been written since the last call that may fault, or in an earlier iteration.
TEST(WriteBacks, FieldsWrittenBeforeACallThatMayFault) {
  const std::string faulting = "function @Risk faults { in x: int; result int }\nbody @Risk { fault div }\n";
  const Analysed b{faulting +
                   "block @B { var x: int; var y: int; var i: int; var r: int }\nbody @B {\n"
                   "r = call @Risk(1)\n"
                   "for i = 0 to 9 by 1 { x = add int x, i\ny = add int y, x\nr = call @Risk(x)\nx = add int x, y }\n"
                   "for i = 0 to 9 by 1 { y = add int y, i }\nr = call @Risk(y)\n}\n"};
  EXPECT_EQ(b.of->write_backs.toString(b.variables()),
            "x before call\ny before call\ni before call\nr before call\n"
            "x before call\ny before call\ni before call\nr before call\n");
}

TEST(CountedLoops, ControlsAreWideWhereTheTypeEnds) {
  const Analysed b = analysed("var i: int; var n: dint; var k: dint; var last: dint",
                              "for i = 0 to 9 by 1 { }\nfor n = 0 to last by 1 { }\nfor k = 0 to 9 by 1 { }");
  EXPECT_EQ(b.of->loops.toString(b.variables()), "i wide 32\nn wide 64\nloop fits\nloop\nloop fits\n");
}

TEST(CountedLoops, NotWhenTheLoopWritesItsControl) {
  const Analysed b = analysed("var i: int", "for i = 0 to 9 by 1 { i = add int i, 1 }");
  EXPECT_EQ(b.of->loops.toString(b.variables()), "");
}

TEST(Lengths, StringsOfSizedFunctionsAreMeasured) {
  const Analysed b = analysed("var s: string[80]; var t: string[80]; var n: int; var i: int",
                              "for i = 0 to 9 by 1 { s = call @Concat(s, 'x')\nn = @Plain(t) }");
  EXPECT_EQ(b.of->measured.toString(b.variables()), "s measured\n");
  EXPECT_EQ(b.of->lengths.toString(b.read.module, *b.body, b.variables()), "count s before a loop\n");
}

TEST(Lengths, AWriteMakesThemKnown) {
  const Analysed b = analysed("var s: string[80]; var n: int; var i: int",
                              "s = 'abc'\nfor i = 0 to 9 by 1 { s = call @Concat(s, 'x') }\nn = @Len(s)");
  EXPECT_EQ(b.of->measured.toString(b.variables()), "s measured\n");
  EXPECT_EQ(b.of->lengths.toString(b.read.module, *b.body, b.variables()), "");
}

// A function @B with these locals; @Touch takes an in-out and its length, @Change changes what it likes.
Analysed analysedFunction(const std::string& locals, const std::string& statements) {
  return Analysed(
      "globals @G { g: string[80]; n: int }\nlist @G: @G\n"
      "function @Touch { inout s: string[80] }\nbody @Touch { s = '' }\n"
      "function @Change { result int }\nbody @Change { result = 1 }\n"
      "block @Other { var own: int }\nbody @Other { call @Touch(@G.g) }\n"
      "function @B { " +
      locals + " }\nbody @B {\n" + statements + "\n}\n");
}

TEST(Lengths, AnInOutIsSharedAndForgottenByWhatMayBeIt) {
  const Analysed b = analysedFunction("inout s: string[80]; inout n: int; out o: int; result int",
                                      "s = call @Concat(s, 'x')\no = 1\nresult = @Len(s)\n@G.n = 1\n"
                                      "result = @Len(s)\n@G.g = 'y'\nresult = @Len(s)\n"
                                      "n = 2\nresult = @Len(s)\nresult = call @Change()\nresult = @Len(s)");
  EXPECT_EQ(b.of->measured.toString(b.variables()), "s measured shared\n");
  EXPECT_EQ(b.of->lengths.toString(b.read.module, *b.body, b.variables()),
            "count s before a statement\nforget shared strings\n"
            "forget shared strings\ncount s before a statement\n"
            "forget shared strings\ncount s before a statement\n"
            "forget shared strings\ncount s before a statement\n");
}

TEST(Lengths, WhatACallMayChangeIsCountedInEachIteration) {
  const Analysed b = analysedFunction(
      "result int",
      "var s: string[80]\nvar i: int\nfor i = 0 to 9 by 1 { result = @Len(s)\ncall @Touch(s)\nresult = @Len(s) }");
  EXPECT_EQ(b.of->measured.toString(b.variables()), "s measured shared\n");
  EXPECT_EQ(b.of->lengths.toString(b.read.module, *b.body, b.variables()),
            "count s before a statement\nforget shared strings\ncount s before a statement\n");
}

TEST(Slices, AStringTakenApartIsASlice) {
  const Analysed b = analysed("in whole: string[80]; var rest: string[80]; var i: int; var n: int",
                              "rest = whole\nfor i = 0 to 9 by 1 { rest = call @Mid(rest, 9, 2)\nn = @Len(rest) }");
  EXPECT_EQ(b.of->slices.toString(b.variables()), "rest slice\n");
}

TEST(Slices, NotWhenItIsPassedWithoutItsLength) {
  const Analysed b = analysed("in whole: string[80]; var rest: string[80]; var i: int; var n: int",
                              "rest = whole\nfor i = 0 to 9 by 1 { rest = call @Mid(rest, 9, 2)\nn = @Plain(rest) }");
  EXPECT_EQ(b.of->slices.toString(b.variables()), "");
}

TEST(Effort, FunctionsThatWorkOnStringsAreOptimizedWhole) {
  std::string statements;
  for (int i = 0; i < 9; ++i) statements += "result = add int result, @Len(s)\n";
  EXPECT_EQ(analysedFunction("inout s: string[80]; result int", statements).of->effort, Effort::Plain);
}

TEST(Effort, LongBodiesWithoutLoopsAreStraight) {
  std::string statements;
  for (int i = 0; i < 9; ++i) statements += "x = add int x, 1\n";
  EXPECT_EQ(analysed("var x: int; var i: int", statements).of->effort, Effort::Straight);
  EXPECT_EQ(analysed("var x: int; var i: int", "for i = 0 to 99 by 1 { " + statements + "}").of->effort, Effort::Loops);
  EXPECT_EQ(analysed("var x: int; var i: int", "x = 1").of->effort, Effort::Plain);
  const std::string checked = "for i = 0 to 99 by 1 { x = a[i]!\n" + statements + "}";
  EXPECT_EQ(analysed("var x: int; var i: int; var a: array[0..9] of int", checked).of->effort, Effort::CheckedLoops);
}

std::string heldBytes(const std::string& statements) {
  const Analysed b = analysed("var x: bool; var y: bool; var w: word; inout r: bool", statements);
  std::string text;
  for (const HeldByte& held : b.of->held)
    text += std::to_string(held.byte) + " cleared " + std::to_string(held.cleared) + " statements " +
            std::to_string(held.first.index) + ".." + std::to_string(held.last.index) + "\n";
  return text;
}

TEST(HeldBytes, BitsThatNothingReadsBeforeAreCleared) {
  EXPECT_EQ(heldBytes("bool %M4.0 = x\nbool %M4.1 = bool %M4.0\nbool %M4.2 = not bool bool %M4.2"),
            "4 cleared 3 statements 1..3\n");
  EXPECT_EQ(heldBytes("if x { bool %M4.0 = 1 }\nbool %M4.0 = y\nbool %M4.3 = y"), "4 cleared 8 statements 2..4\n");
}

TEST(HeldBytes, OneStoreIsNotWorthIt) { EXPECT_EQ(heldBytes("bool %M4.0 = x\nbool %M5.0 = x"), ""); }

TEST(HeldBytes, OtherWaysToTheByteEndIt) {
  EXPECT_EQ(heldBytes("bool %M4.0 = x\nbool %M4.1 = x\nw = word %M3\nbool %M4.2 = x"), "4 cleared 3 statements 1..2\n");
  EXPECT_EQ(heldBytes("bool %M4.0 = x\nbool %M4.1 = x\nw = word %M5\nbool %M4.2 = x"), "4 cleared 7 statements 1..4\n");
  EXPECT_EQ(heldBytes("bool %M4.0 = x\ny = r\nbool %M4.2 = x"), "");
  EXPECT_EQ(heldBytes("bool %M4.0 = x\nif x { return }\nbool %M4.2 = x"), "");
}

TEST(HeldBytes, FourAtOnce) {
  EXPECT_EQ(heldBytes("bool %M1.0 = x\nbool %M2.0 = x\nbool %M3.0 = x\nbool %M4.0 = x\nbool %M5.0 = x\n"
                      "bool %M1.1 = x\nbool %M3.1 = x\nbool %M4.1 = x"),
            "3 cleared 3 statements 3..7\n4 cleared 3 statements 4..8\n");
}

}  // namespace
}  // namespace rung::codegen
