// SPDX-License-Identifier: Apache-2.0
// The interpreter on functions of IR text: control flow, calls, memory, faults. Expected values are computed by hand.
#include "ir/interpreter/function.h"

#include <gtest/gtest.h>

#include "../ir_text.h"

namespace rung::ir::interpreter {
namespace {

FunctionResult runText(const std::string& text, std::vector<types::Value> arguments = {}) {
  TestModule m(text);
  EXPECT_TRUE(m.ok) << m.errors();
  for (uint32_t i = 1; i < m.module.bodies.size(); ++i) {
    if (m.names.string(m.module.bodies[i].name) == "f")
      return runFunction(m.module, {i}, arguments, {}, 100'000, m.names);
  }
  return {};
}
types::Value ofInt(int64_t value) { return {types::kInt, static_cast<uint64_t>(value)}; }

// The INT that the body of @f returns for n.
int64_t value(const std::string& body, int64_t n, const std::string& before = "") {
  const FunctionResult r =
      runText(before + "function @f faults { in n: int; result int }\nbody @f {\n" + body + "\n}\n", {ofInt(n)});
  EXPECT_EQ(r.trouble, "");
  EXPECT_EQ(r.fault, types::Fault::None);
  return r.value.asSigned();
}
types::Fault fault(const std::string& body, int64_t n) {
  return runText("function @f faults { in n: int; result int }\nbody @f {\n" + body + "\n}\n", {ofInt(n)}).fault;
}

TEST(InterpreterFunction, ForAtTheEdgesOfTheType) {
  const std::string count =
      "var u: usint\n for u = 250 to 255 by 1 { result = add int result, 1 }\n"
      " result = add int (mul int result, 1000), (convert int u)";
  EXPECT_EQ(value(count, 0), 6255);  // six iterations; the next value does not fit
  const std::string down =
      "var s: sint\n for s = -127 to -128 by -1 { result = add int result, 1 }\n"
      " result = add int (mul int result, 1000), (convert int s)";
  EXPECT_EQ(value(down, 0), 2000 - 128);
  EXPECT_EQ(value("var i: int\n for i = 5 to 5 by 1 { result = add int result, 1 }\n result = add int (mul int result, "
                  "100), i",
                  0),
            106);
  EXPECT_EQ(value("var i: int\n for i = n to 4 by 1 { result = add int result, 1 }\n result = add int (mul int result, "
                  "100), i",
                  7),
            7);
  EXPECT_EQ(value("var i: int\n for i = 0 to n by 3 { if eq int i, 6 { break } if eq int i, 3 { continue }\n"
                  " result = add int result, 1 }\n result = add int (mul int result, 100), i",
                  20),
            106);
}

// A control that other code can reach is read and written in each iteration.
TEST(InterpreterFunction, ForOverAnInOut) {
  EXPECT_EQ(value("var i: int\n temp t: int\n %t = call @count(i)\n result = add int (mul int i, 100), %t", 0,
                  "function @count { inout c: int; result int }\n"
                  "body @count { for c = 1 to 10 by 2 { result = add int result, 1\n"
                  " if eq int c, 3 { c = 8 } } }\n"),
            // 1, 3 (becomes 8), 10: then 12
            1203);
}

TEST(InterpreterFunction, Switches) {
  const std::string dense = "switch n { case 1, 3..5 { return 10 } case 2 { return 20 } else { return 30 } }";
  EXPECT_EQ(value(dense, 1), 10);
  EXPECT_EQ(value(dense, 2), 20);
  EXPECT_EQ(value(dense, 5), 10);
  EXPECT_EQ(value(dense, 0), 30);
  EXPECT_EQ(value(dense, 6), 30);
  EXPECT_EQ(value(dense, -32768), 30);
  const std::string wide =
      "switch n { case -30000..-20000 { return 1 } case 0 { return 2 } case 20000..32767 { return 3 } }\n return 4";
  EXPECT_EQ(value(wide, -30000), 1);
  EXPECT_EQ(value(wide, -19999), 4);
  EXPECT_EQ(value(wide, 0), 2);
  EXPECT_EQ(value(wide, 32767), 3);
  EXPECT_EQ(value(wide, -32768), 4);
}

TEST(InterpreterFunction, LoopsAndJumps) {
  EXPECT_EQ(value("loop { if gt int result, 9 { break }\n n = sub int n, 1\n if lt int n, 0 { continue }\n"
                  " result = add int result, n } next { result = add int result, 1 }",
                  3),
            // n 2: 2, 3; n 1: 4, 5; n 0: 5, 6; below: 7, 8, 9, 10
            10);
  EXPECT_EQ(value("label again\n result = add int result, n\n n = sub int n, 1\n if gt int n, 0 { jump again }", 4),
            10);
}

TEST(InterpreterFunction, TriesAndTheirExits) {
  EXPECT_EQ(value("try { result = div! int 1, n } catch result { result = add int result, 10 }", 0), 11);
  EXPECT_EQ(value("try { result = div! int 8, n } catch result { result = 99 }", 2), 4);
  // Each exit runs the finally block of each try that it leaves.
  const std::string exits =
      "var i: int\n for i = 1 to 10 by 1 {\n try { try {\n"
      " if eq int i, n { break }\n if eq int i, 2 { continue }\n if eq int i, 4 { return add int result, 1000 }\n"
      " result = add int result, 1\n } finally { result = add int result, 10 } } finally { result = add int result, "
      "100 "
      "} }";
  EXPECT_EQ(value(exits, 1), 110);
  EXPECT_EQ(value(exits, 3), 111 + 110 + 110);
  // `return` evaluates its result first; the finally blocks run after it.
  EXPECT_EQ(value(exits, 9), 1000 + 111 + 110 + 111 + 110);
  // A fault passes through finally, and through catch when it faults again.
  EXPECT_EQ(
      value("try { try { result = div! int 1, n } finally { result = 5 } } catch { result = add int result, 1 }", 0),
      6);
  EXPECT_EQ(value("try { try { n = div! int 1, n } catch { result = 1\n n = div! int 1, n\n result = 2 } finally {"
                  " result = add int result, 20 } } catch { result = add int result, 300 }",
                  0),
            321);
  EXPECT_EQ(fault("try { n = div! int 1, n } catch { n = mod! int 1, n }", 0), types::Fault::Div);
}

TEST(InterpreterFunction, CallsNestInArguments) {
  const std::string twice =
      "function @twice pure { in a: int; in b: int; result int }\n"
      "body @twice { return add int (mul int a, 10), b }\n";
  EXPECT_EQ(value("return @twice(@twice(1, 2), @twice(n, @twice(0, 5)))", 3, twice), 120 + 35);
  EXPECT_EQ(value("return add int @twice(1, n), @twice(2, n)", 3, twice), 13 + 23);
}

TEST(InterpreterFunction, OutputsAndDiscardedOnes) {
  const std::string both =
      "function @both { in a: int; out b: int; out c: int; result int }\n"
      "body @both { b = add int a, 1\n c = add int a, 2\n return mul int a, 2 }\n";
  EXPECT_EQ(
      value("temp t: int\n temp u: int\n %t = call @both(n, _, %u)\n return add int (mul int %t, 100), %u", 7, both),
      1409);
}

TEST(InterpreterFunction, ArraysByReferenceAndByCopy) {
  const std::string sum =
      "function @sum pure { in a: array[1..3] of int; result int }\n"
      "body @sum { return add int (add int a[1], a[2]), a[3] }\n";
  EXPECT_EQ(value("var a: array[1..3] of int\n var b: array[1..3] of int\n a = zero\n a[n]! = 5\n b = a\n a[1] = 7\n"
                  " return add int (mul int @sum(a), 100), @sum(b)",
                  2, sum),
            1205);
  EXPECT_EQ(fault("var a: array[1..3] of int\n a = zero\n a[n]! = 5", 4), types::Fault::Index);
  EXPECT_EQ(fault("var a: array[1..3] of int\n a = zero\n return a[n]!", 0), types::Fault::Index);
  EXPECT_EQ(value("var m: array[1..2, 5..7] of int\n m = zero\n m[n, 6]! = 3\n m[2, add int n, 4] = 4\n"
                  " return add int (mul int m[1, 6], 10), m[2, 5]",
                  1),
            34);
}

// The first check in source order faults first.
TEST(InterpreterFunction, ChecksAreInOrder) {
  EXPECT_EQ(fault("var a: array[1..3] of int\n a = zero\n a[n]! = div! int 1, (sub int n, n)", 9), types::Fault::Index);
  EXPECT_EQ(fault("var a: array[1..3] of int\n a = zero\n a[n]! = div! int 1, (sub int n, n)", 2), types::Fault::Div);
}

TEST(InterpreterFunction, BitsAndParts) {
  EXPECT_EQ(value("var w: word\n w = 0\n w.%X3 = true\n w.%B1 = 18\n return convert int w", 0), 0x1208);
  EXPECT_EQ(value("var w: word\n w = 6\n if w.%X1 { result = 1 }\n if w.%X0 { result = 2 }\n"
                  " return add int result, (mul int (convert int w.%B0), 10)",
                  0),
            61);
}

TEST(InterpreterFunction, Texts) {
  const FunctionResult r = runText(
      "function @f { in s: string[20]; result string[5] }\n"
      "body @f { if eq string[20] s, string[3]#'abc' { return 'same' } result = s }\n",
      {});
  EXPECT_EQ(r.trouble, "");
  TestModule m(
      "function @f { in s: string[20]; result string[5] }\n"
      "body @f { if eq string[20] s, string[3]#'abc' { return 'same' } result = s }\n");
  ASSERT_TRUE(m.ok);
  const auto run = [&](const char* text) {
    const types::Value given{m.types.string(20), m.names.intern(text).index};
    const FunctionResult result = runFunction(m.module, {1}, {&given, 1}, {}, 1000, m.names);
    return std::string(m.names.string(NameId{static_cast<uint32_t>(result.value.bits)}));
  };
  EXPECT_EQ(run("abc"), "same");
  EXPECT_EQ(run("abcdefg"), "abcde");
  EXPECT_EQ(run(""), "");
}

TEST(InterpreterFunction, ChecksOnRequest) {
  const std::string types = "subrange @Percent: int 0..100\n";
  const std::string convert = types +
                              "function @f faults { in n: int; result int }\n"
                              "body @f { var p: @Percent\n p = convert! @Percent n\n return convert int p }\n";
  EXPECT_EQ(runText(convert, {ofInt(100)}).value.asSigned(), 100);
  EXPECT_EQ(runText(convert, {ofInt(101)}).fault, types::Fault::Subrange);
  EXPECT_EQ(runText(convert, {ofInt(-1)}).fault, types::Fault::Subrange);
  const std::string narrow = "function @f faults { in n: int; result usint }\nbody @f { return convert! usint n }\n";
  EXPECT_EQ(runText(narrow, {ofInt(255)}).value.bits, 255u);
  EXPECT_EQ(runText(narrow, {ofInt(256)}).fault, types::Fault::Convert);
  EXPECT_EQ(runText(narrow, {ofInt(-1)}).fault, types::Fault::Convert);
  EXPECT_EQ(fault("return add! int n, 1", 32767), types::Fault::Overflow);
  EXPECT_EQ(fault("return neg! int n", -32768), types::Fault::Overflow);
  EXPECT_EQ(fault("return mul! int n, 2", 16383), types::Fault::None);
  EXPECT_EQ(fault("return mul! int n, 2", 16384), types::Fault::Overflow);
}

TEST(InterpreterFunction, EndlessAndTooDeep) {
  EXPECT_NE(runText("function @f { in n: int; result int }\nbody @f { loop { } }\n", {ofInt(0)}).trouble, "");
  EXPECT_NE(runText("function @f { in n: int; result int }\nbody @f { label a\n jump a }\n", {ofInt(0)}).trouble, "");
  EXPECT_NE(runText("function @f { in n: int; result int }\n"
                    "body @f { temp t: int\n %t = call @f(n)\n return add int %t, 1 }\n",
                    {ofInt(0)})
                .trouble,
            "");
}

}  // namespace
}  // namespace rung::ir::interpreter
