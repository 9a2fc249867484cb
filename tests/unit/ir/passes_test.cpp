// SPDX-License-Identifier: Apache-2.0
// Passes over random functions: the verifier accepts each step, the evaluator gives the same value or fault before and
// after, and a second run changes nothing. The tests of single passes are in tests/golden/ir.
#include "ir/passes/passes.h"

#include <gtest/gtest.h>

#include <ctime>
#include <random>

#include "evaluator.h"
#include "ir/verify.h"
#include "ir_text.h"

namespace rung::ir {
namespace {

// Writes a function over SINT, USINT and BOOL locals that always ends.
class Writer {
 public:
  explicit Writer(uint32_t seed) : random_(seed) {}

  std::string function() {
    text_ =
        "subrange @Slot: sint 0..5\n"
        "function @g pure { in p: sint; result sint }\nbody @g { return mul sint p, 3 }\n"
        "function @h { in p: sint; inout q: sint; out r: sint; result sint }\n"
        "body @h { r = add sint p, q\n q = 4\n return sub sint r, 1 }\n"
        "function @f faults { in a: sint; in b: sint; in c: bool; result sint }\n"
        "body @f {\n"
        " var x: sint\n var y: sint\n var s: @Slot\n var d: bool\n var m: array[-2..5] of sint\n"
        " temp t1: sint\n temp t2: sint\n temp t3: sint\n";
    block(3);
    text_ += "}\n";
    return text_;
  }

 private:
  uint32_t pick(uint32_t count) { return static_cast<uint32_t>(random_() % count); }
  const char* local() {
    static const char* const kLocals[] = {"a", "b", "x", "y", "%t1", "%t2", "result", "%t3"};
    return kLocals[pick(8)];
  }
  std::string constant() {
    static const char* const kConstants[] = {"0", "1", "-1", "2", "3", "5", "7", "-128", "127", "100"};
    return kConstants[pick(10)];
  }
  std::string element() { return "m[" + integer(1) + "]!"; }

  std::string integer(int depth) {
    if (depth == 0) return pick(3) == 0 ? "sint#" + constant() : local();
    static const char* const kOps[] = {"add", "sub", "mul",  "and",  "or",  "xor",
                                       "min", "max", "div!", "mod!", "shr", "shl"};
    switch (pick(9)) {
      case 0: return "sint#" + constant();
      case 1:
      case 2: return local();
      case 3: return element();
      case 4: return "(select sint " + boolean(depth - 1) + ", " + integer(depth - 1) + ", " + integer(depth - 1) + ")";
      case 5: return "(convert!(subrange) @Slot " + integer(depth - 1) + ")";
      case 6: return "@g(" + integer(depth - 1) + ")";
      default: {
        const std::string op = kOps[pick(12)];
        std::string right = integer(depth - 1);
        if (op[0] == 's' && op[1] == 'h') right = "(and sint " + right + ", 15)";
        return "(" + op + " sint " + integer(depth - 1) + ", " + right + ")";
      }
    }
  }
  std::string boolean(int depth) {
    static const char* const kOps[] = {"eq", "ne", "lt", "le", "gt", "ge"};
    if (depth <= 0) return pick(4) == 0 ? (pick(2) ? "true" : "false") : (pick(2) ? "c" : "d");
    switch (pick(5)) {
      case 0: return "(not bool " + boolean(depth - 1) + ")";
      case 1: return "(and bool " + boolean(depth - 1) + ", " + boolean(depth - 1) + ")";
      case 2: return "(or bool " + boolean(depth - 1) + ", " + boolean(depth - 1) + ")";
      default:
        return std::string("(") + kOps[pick(6)] + " sint " + integer(depth - 1) + ", " + integer(depth - 1) + ")";
    }
  }
  void block(int depth) {
    for (uint32_t n = 1 + pick(4); n > 0; --n) statement(depth);
  }
  void statement(int depth) {
    switch (pick(depth > 0 ? 14 : 6)) {
      case 0:
      case 1: text_ += std::string(local()) + " = " + integer(2) + "\n"; return;
      case 2: text_ += element() + " = " + integer(2) + "\n"; return;
      case 3: text_ += "d = " + boolean(2) + "\n"; return;
      case 4: text_ += "s = convert!(subrange) @Slot " + integer(1) + "\n"; return;
      case 5:
        text_ += std::string(local()) + " = call @h(" + integer(1) + ", x, " + (pick(2) ? "_" : "y") + ")\n";
        return;
      case 6:
      case 7:
        text_ += "if " + boolean(2) + " {\n";
        block(depth - 1);
        if (pick(2)) {
          text_ += "} else {\n";
          block(depth - 1);
        }
        text_ += "}\n";
        return;
      case 8:
        text_ += "switch " + std::string(local()) + " {\ncase 0..3 {\n";
        block(depth - 1);
        text_ += "}\ncase 7, -1 {\n";
        block(depth - 1);
        text_ += "}\n";
        if (pick(2)) {
          text_ += "else {\n";
          block(depth - 1);
          text_ += "}\n";
        }
        text_ += "}\n";
        return;
      case 9:
      case 10: {
        // The control of the outer loop is another local, so both loops end.
        text_ += std::string("for ") + (depth > 2 ? "x" : "y") + " = " + integer(1) + " to " + integer(1) + " by " +
                 (pick(2) ? "1" : "-2") + " {\n";
        ++loops_;
        block(depth - 1);
        --loops_;
        text_ += "}\n";
        return;
      }
      case 11:
        text_ += "%t3 = 0\nloop {\nif gt sint %t3, 3 { break }\n";
        ++loops_;
        block(depth - 1);
        --loops_;
        text_ += "%t3 = add sint %t3, 1\n} next {\n" + std::string(local()) + " = add sint %t3, 2\n}\n";
        return;
      case 12:
        text_ += "try {\n";
        block(depth - 1);
        text_ += "} catch {\n";
        block(depth - 1);
        text_ += "}\n";
        return;
      default:
        if (loops_ > 0 && pick(2))
          text_ += "if " + boolean(1) + (pick(2) ? " { break }\n" : " { continue }\n");
        else
          text_ += "if " + boolean(1) + " { return " + integer(1) + " }\n";
        return;
    }
  }

  std::mt19937 random_;
  std::string text_;
  int loops_ = 0;
};

TEST(Passes, RandomFunctionsMeanTheSame) {
  int compared = 0, faults = 0;
  for (uint32_t seed = 1; seed <= 400; ++seed) {
    const std::string text = Writer(seed).function();
    TestModule before(text), after(text);
    ASSERT_TRUE(before.ok) << before.errors() << text;
    for (const std::string& line : verify(before.module)) FAIL() << line << "\n" << text;
    std::string history;
    for (int round = 0; round < 2; ++round) {
      optimize(after.module, 1, [&](const Pass& pass, Body& body) {
        for (const std::string& line : verify(after.module, body))
          history += std::string(pass.name) + ": " + line + "\n";
      });
    }
    ASSERT_EQ(history, "") << text;
    for (int a : {0, 1, -1, 5, 127, -128}) {
      for (int b : {0, 2, -3}) {
        const std::vector<types::Value> arguments = {{types::kSInt, static_cast<uint64_t>(int64_t{a})},
                                                     {types::kSInt, static_cast<uint64_t>(int64_t{b})},
                                                     {types::kBool, static_cast<uint64_t>(a & 1)}};
        const RunResult one = run(before.module, *before.find("f"), arguments);
        if (!one.trouble.empty()) continue;  // does not end
        const RunResult two = run(after.module, *after.find("f"), arguments);
        ASSERT_EQ(two.trouble, "") << "seed " << seed << " (" << a << ", " << b << ")\n" << text << print(after.module);
        ASSERT_EQ(static_cast<int>(one.fault), static_cast<int>(two.fault))
            << "seed " << seed << " (" << a << ", " << b << ")\n"
            << text << print(after.module);
        if (one.fault == types::Fault::None) {
          ASSERT_EQ(one.value.bits, two.value.bits) << "seed " << seed << " (" << a << ", " << b << ")\n"
                                                    << text << print(after.module);
        }
        ++compared;
        faults += one.fault != types::Fault::None;
      }
    }
  }
  EXPECT_GT(compared, 2000);
  EXPECT_GT(faults, 100);
}

// Time grows with the size, not with its square: ten times the statements may take up to thirty times as long.
TEST(Passes, TimeIsNearLinear) {
  const auto secondsFor = [](int count) {
    std::string text =
        "function @f faults { in i: int; in c: bool; result int }\nbody @f {\n var a: array[0..9] of int\n";
    for (int k = 0; k < count; ++k) text += " var v" + std::to_string(k) + ": int\n";
    for (int k = 0; k < count; ++k) {
      const std::string v = "v" + std::to_string(k);
      text += v + " = add int i, 3\nif lt int " + v + ", 5 { if c { a[" + v + "]! = 1 } else { " + v +
              " = 2 } }\nresult = add int result, " + v + "\n";
    }
    text += "}\n";
    TestModule m(text);
    EXPECT_TRUE(m.ok);
    const std::clock_t start = std::clock();
    optimize(m.module, 1, [](const Pass&, Body&) {});
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  secondsFor(1000);
  const double small = secondsFor(1000), large = secondsFor(10000);
  EXPECT_LT(large, 30 * small + 0.05);
}

TEST(Passes, DeepNestingIsNoTrouble) {
  std::string text = "function @f { in c: bool; result int }\nbody @f {\n var k: int\n";
  for (int i = 0; i < 900; ++i) text += "if c { k = " + std::to_string(i) + "\n";
  for (int i = 0; i < 900; ++i) text += "}\n";
  text += "return k }\n";
  TestModule m(text);
  ASSERT_TRUE(m.ok) << m.errors();
  optimize(m.module, 1, [](const Pass&, Body&) {});
  EXPECT_TRUE(verify(m.module).empty());
}

}  // namespace
}  // namespace rung::ir
