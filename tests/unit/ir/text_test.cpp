// SPDX-License-Identifier: Apache-2.0
// The text form: every node prints as in docs/ir.md, and printed text reads back to the same print.
#include "ir/text.h"

#include <gtest/gtest.h>

#include "ir/verify.h"
#include "ir_text.h"

namespace rung::ir {
namespace {

std::string verified(const Module& module) {
  std::string out;
  for (const std::string& line : verify(module)) out += line + "\n";
  return out;
}

// Text in printed form: reads without error, verifies, and prints identically to the byte.
void expectStable(const std::string& text) {
  TestModule first(text);
  ASSERT_TRUE(first.ok) << first.errors();
  EXPECT_EQ(verified(first.module), "");
  EXPECT_EQ(print(first.module), text);
}

// A body in a function with locals of many types.
std::string inFunction(const std::string& statements) {
  return "enum @Color: int { Red = 0; Green = 5 }\n"
         "subrange @Percent: int 0..100\n"
         "struct @Point { x: real; y: real; link: pointer to @Point }\n"
         "block @Ramp { in up: bool; inout level: real; out y: real; a: array[0..9] of int }\n"
         "globals @GVL { g: int; p: @Point }\n"
         "program @Main { x: int }\n"
         "area I input 8\narea Q output 8\narea M memory 8\n"
         "data 0: array[0..1] of int \"01000200\"\n"
         "list @GVL: @GVL\n"
         "instance $Main: @Main\n"
         "\n"
         "body @Ramp {\n}\n"
         "\n"
         "init @Ramp {\n}\n"
         "\n"
         "function @pureAdd pure { in a: int; in b: int; result int }\n"
         "body @pureAdd {\n  return add int a, b\n}\n"
         "\n"
         "function @swap { inout a: int; out b: int; in s: string[10]; result int }\n"
         "body @swap {\n}\n"
         "\n"
         "function @f faults { in i: int; in b: bool; in r: real; inout io: int; result int }\n"
         "body @f {\n"
         "  var u: ulint\n"
         "  var w: word\n"
         "  var l: lreal\n"
         "  var s: string[80]\n"
         "  var ws: wstring[8]\n"
         "  var c: @Color\n"
         "  var pc: @Percent\n"
         "  var pt: @Point\n"
         "  var m: array[1..3, -1..1] of int\n"
         "  var ptr: pointer to int\n"
         "  var ramp: @Ramp\n"
         "  var tm: time\n"
         "  var `loop`: int\n"
         "  var `tür`: int\n"
         "  temp t1: int\n" +
         statements + "}\n";
}
void expectStatements(const std::string& statements) {
  std::string indented;
  size_t from = 0;
  while (from < statements.size()) {
    size_t end = statements.find('\n', from);
    indented += "  " + statements.substr(from, end - from) + "\n";
    from = end + 1;
  }
  std::string text = inFunction(indented);
  // `tür` is printed with its bytes as escapes.
  size_t at = text.find("`tür`");
  text.replace(at, std::string("`tür`").size(), "`t$C3$BCr`");
  TestModule needed(text);
  ASSERT_TRUE(needed.ok) << needed.errors();
  // Types are declared in order of use; only the body is compared here.
  Body* body = needed.find("f");
  ASSERT_NE(body, nullptr);
  std::string printed = print(needed.module, *body);
  EXPECT_EQ(printed, text.substr(text.find("function @f ")));
  EXPECT_EQ(verified(needed.module), "");
  std::string whole = print(needed.module);
  TestModule again(whole);
  ASSERT_TRUE(again.ok) << again.errors() << whole;
  EXPECT_EQ(print(again.module), whole);
}

TEST(IrText, DesignExample) {
  expectStable(
      "block @Ramp \"ramp.st\":1 { in up: bool; in step: real; out y: real }\n"
      "\n"
      "body @Ramp {\n"
      "  if up {\n"
      "    y = add real y, step\n"
      "  } else {\n"
      "    y = 0.0\n"
      "  }\n"
      "}\n");
}

TEST(IrText, OneLineFormReads) {
  TestModule module(
      "block @Ramp \"ramp.st\":1 { in up: bool; in step: real; out y: real }\n"
      "body @Ramp { if up { y = add real y, step } else { y = 0.0 } }\n");
  ASSERT_TRUE(module.ok) << module.errors();
  EXPECT_EQ(squeeze(print(module.module, *module.find("Ramp"))),
            "body @Ramp { if up { y = add real y, step } else { y = 0.0 } }");
}

TEST(IrText, ModuleItems) {
  expectStable(
      "enum @Color: int strict { Red = 0; Green = 5 }\n"
      "subrange @Percent: int 0..100\n"
      "struct @Point \"a b.st\":3 library { x: real; c: @Color; p: @Percent }\n"
      "union @U { i: int; w: word }\n"
      "block @Ramp { in up: bool; inout level: real; var retain n: int; out persistent y: real }\n"
      "program @Main { in ref s: string[80]; ramp: @Ramp; m: array[0..3, 1..2] of @Point }\n"
      "globals @GVL { constant k: int; p: pointer to @Point; r: reference to int }\n"
      "area I input 4\n"
      "area Q output 2\n"
      "data 0: array[0..3] of int \"01000200 0300ffff\"\n"
      "list @GVL: @GVL configuration Conf\n"
      "aligned_globals\n"
      "io_module \"ad\" \"AX_EM_4AD\" station \"rack\" bus_task 1 inputs 4 outputs 8\n"
      "io_module \"di\" \"AX_EM_1600D\"\n"
      "task Fast cyclic interval 10000000 priority 1 watchdog 20000000 sensitivity 2 duration 3000000\n"
      "task Ev event trigger \"GVL.flag\"\n"
      "task Ax external external \"drive\"\n"
      "task Fast.2 cyclic resource Other interval 10000000\n"
      "instance $Main: @Main task Fast resource Res configuration Conf\n"
      "instance $m2: @Main\n"
      "instance $Main.2: @Main task Fast.2 resource Other configuration Conf\n"
      "located start: bool%I0.5 of $Main\n"
      "located end: bool%I0.6 of $Main.2\n"
      "located _: int%Q0\n"
      "located lamp: bool%Q0.5 of_list @GVL configuration Conf\n"
      "test @Main\n"
      "test @Main setup @`Main~case1` as \"Main(a := 'x$\"')\"\n"
      "\n"
      "body @Main \"m.st\":9 as \"MAIN\" test {\n"
      "  call @Ramp on ramp\n"
      "}\n"
      "\n"
      "body @Ramp {\n"
      "  y = convert real n\n"
      "}\n"
      "\n"
      "init @Main {\n"
      "  m[0, 1].x = 1.5\n"
      "}\n"
      "\n"
      "function @`Main~case1` {}\n"
      "body @`Main~case1` {\n"
      "}\n"
      "\n"
      "function @ABS__INT \"x.st\":1 as \"ABS\" native Standard pure library { in IN: int; result int }\n");
}

TEST(IrText, Constants) {
  expectStatements(
      "i = 5\n"
      "i = -32768\n"
      "u = 18446744073709551615\n"
      "b = true\n"
      "r = 0.1\n"
      "r = -0.0\n"
      "r = 1e+20\n"
      "r = inf\n"
      "r = -inf\n"
      "r = nan\n"
      "l = 0.30000000000000004\n"
      "tm = 1500\n"
      "c = @Color#Green\n"
      "c = 7\n"
      "pc = 50\n"
      "ptr = null\n"
      "s = string[3]#'a$'$$'\n"
      "s = 'x$0Ay'\n"
      "ws = 'x'\n"
      "pt = zero\n"
      "evaluate dint#5\n"
      "evaluate data 0\n"
      "evaluate @Point#zero\n"
      "return 3\n");
}

TEST(IrText, Places) {
  expectStatements(
      "`loop` = `t$C3$BCr`\n"
      "%t1 = i\n"
      "result = 1\n"
      "m[i, 2] = 3\n"
      "m[2, sub int i, 1]! = 4\n"
      "pt.x = pt.y\n"
      "ptr^! = 5\n"
      "pt.link^.link^!.x = 1.0\n"
      "@GVL.g = $Main.x\n"
      "@GVL.p.x = 1.0\n"
      "int%Q4 = int%I2\n"
      "bool%Q0.7 = w.%X15\n"
      "w.%B1 = byte%M3\n"
      "ramp.level! = 2.0\n"
      "bind ramp.level = r\n"
      "io = ramp.a[3]\n");
}

TEST(IrText, Values) {
  expectStatements(
      "i = add int i, (mul! int i, 3)\n"
      "i = div! int i, %t1\n"
      "i = mod!(div, overflow) int i, %t1\n"
      "i = neg int i\n"
      "b = not bool (lt int i, 3)\n"
      "b = eq string[80] s, string[1]#'x'\n"
      "w = shl word w, int#3\n"
      "r = power real r, int#2\n"
      "w = shl word w, i\n"
      "r = convert real i\n"
      "pc = convert! @Percent i\n"
      "i = convert! int (mul real r, 2.0)\n"
      "i = select int b, i, (neg int i)\n"
      "ptr = address pointer to int m[1, 0]\n"
      "i = add int @pureAdd(i, 3), 1\n"
      "i = (address pointer to int io)^\n");
}

TEST(IrText, Statements) {
  expectStatements(
      "%t1 = call @swap(io, _, string[3]#'abc')\n"
      "call @swap(io, %t1, s)\n"
      "call @Ramp on ramp\n"
      "call init @Ramp on ramp\n"
      "if b {\n"
      "}\n"
      "if b {\n"
      "  i = 1\n"
      "} else {\n"
      "  i = 2\n"
      "}\n"
      "switch i {\n"
      "  case 1, 3..5 {\n"
      "    i = 0\n"
      "  }\n"
      "  case -7 {\n"
      "  }\n"
      "  else {\n"
      "    return\n"
      "  }\n"
      "}\n"
      "switch u {\n"
      "  case 9223372036854775808..18446744073709551615 {\n"
      "  }\n"
      "}\n"
      "loop {\n"
      "  if b {\n"
      "    break\n"
      "  }\n"
      "  continue\n"
      "} next {\n"
      "  i = add int i, 1\n"
      "}\n"
      "for i = 0 to add int %t1, 1 by -2 {\n"
      "  m[1, 1] = i\n"
      "}\n"
      "try {\n"
      "  fault div(i)\n"
      "} catch i {\n"
      "  fault null\n"
      "} finally {\n"
      "  b = false\n"
      "}\n"
      "try {\n"
      "}\n"
      "assert b\n"
      "assert b text 'held'\n"
      "assert gt int i, 3 shows i, 3 as 'i > 3$0Ai$0A' text 'held'\n"
      "assert_eq 3, i\n"
      "assert_near r, 1.0, 0.5 text 'near'\n"
      "evaluate ptr^!\n"
      "label again\n"
      "if b {\n"
      "  jump again\n"
      "}\n"
      "return\n");
}

TEST(IrText, ShadowedFieldsAreQualified) {
  expectStable(
      "block @B { x: int; y: int }\n"
      "\n"
      "body @B {\n"
      "  var x: int\n"
      "  temp y: int\n"
      "  x = self.x\n"
      "  y = %y\n"
      "}\n");
}

TEST(IrText, TypesOfOneNameAreReported) {
  // Two blocks with a local enumeration each: the second is `@State.2`.
  Names names;
  Sources sources;
  types::TypeTable types(names, 8);
  Module module(types, names, sources);
  const NameId state = names.intern("State");
  for (int i = 0; i < 2; ++i) {
    const TypeId created = types.addEnum(state, types::kInt);
    types.edit(created).items.emplace_back(names.intern("Off"), i);
    const TypeId record = types.addRecord(types::RecordKind::Struct, names.intern(i == 0 ? "A" : "B"));
    types::Field field;
    field.name = names.intern("s");
    field.type = created;
    types.edit(record).fields.push_back(field);
    types.layout(record);
    Record listed;
    listed.type = record;
    listed.name = types.info(record).name;
    module.records.push_back(listed);
  }
  const std::string text = print(module);
  EXPECT_EQ(text,
            "enum @State: int { Off = 0 }\n"
            "enum @State.2: int { Off = 1 }\n"
            "struct @A { s: @State }\n"
            "struct @B { s: @State.2 }\n");
  TestModule again(text);
  ASSERT_TRUE(again.ok) << again.errors();
  EXPECT_EQ(print(again.module), text);
}

// ---- mistakes

std::string errorsOf(const std::string& text) {
  TestModule module(text);
  EXPECT_FALSE(module.ok);
  return module.errors();
}

TEST(IrText, MistakesAreNamedOnceEach) {
  EXPECT_EQ(errorsOf("function @f { in x int }\n"), "1:20 E0901 expected `:`, found `int`\n");
  EXPECT_EQ(errorsOf("function @f { result int }\nbody @f { y = 3 }\n"),
            "2:11 E0902 unknown variable `y` in this module; declare it, or correct the name\n");
  EXPECT_EQ(errorsOf("function @f { in s: sint; result int }\nbody @f { s = 200 }\n"),
            "2:15 E0903 `200` is not a value of SINT; write the value's type before it, as in `int#3`\n");
  EXPECT_EQ(errorsOf("struct @A { x: int }\nstruct @A { x: int }\n"),
            "2:8 E0904 `A` is declared twice; rename one of them\n");
  EXPECT_EQ(errorsOf("function @f { in s: int }\nbody @f { s.x = 1 }\n"),
            "2:12 E0906 `.` needs a record before it, not INT\n");
  EXPECT_EQ(errorsOf("hello\n"), "1:1 E0901 expected an item (`function`, `body`, `struct`, ...), found `hello`\n");
}

TEST(IrText, EachItemIsReadAfterAMistake) {
  EXPECT_EQ(errorsOf("function @f { in x: int }\nbody @f { x = }\nfunction @g { in x: int }\nbody @g { x = y }\n"),
            "2:15 E0901 expected an expression, found `}`\n"
            "4:15 E0902 unknown variable `y` in this module; declare it, or correct the name\n");
}

TEST(IrText, DeepNestingEndsWithAMessage) {
  std::string deep(20000, '(');
  EXPECT_EQ(errorsOf("function @f { in x: int }\nbody @f { x = " + deep + " }\n").substr(0, 50).find("E0905") !=
                std::string::npos,
            true);
}

TEST(IrText, TruncatedTextIsNoCrash) {
  const std::string text = inFunction("  i = add int i, (mul! int i, 3)\n  s = string[3]#'a$'$$'\n");
  for (size_t length = 0; length < text.size(); ++length) TestModule module(text.substr(0, length));
}

}  // namespace
}  // namespace rung::ir
