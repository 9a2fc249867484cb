// SPDX-License-Identifier: Apache-2.0
// Paths: roots with and without prefixes, fields, indices, bits, in-outs, the image; and setting values.
#include "stdlib/runtime/host/symbols.h"

#include <gtest/gtest.h>

#include "sample_module.h"
#include "stdlib/runtime/host/value_format.h"

using namespace rung::host;

namespace {

struct Paths : testing::Test {
  LoadedModule module{sample::module()};
  Memory memory{module};
  Symbols symbols{module, memory};
  Paths() { memory.reset(); }

  std::string value(const std::string& path) {
    Variable variable;
    std::string text;
    if (symbols.find(path, variable, text)) formatValue(module, variable, text);
    return text;
  }
  std::string set(const std::string& path, const std::string& literal) {
    Variable variable;
    std::string error;
    if (!symbols.find(path, variable, error)) return error;
    return assignValue(module, variable, literal);
  }
};

TEST_F(Paths, FindValues) {
  EXPECT_EQ(value("Main.level"), "0.5");
  EXPECT_EQ(value("main.COLOR"), "Green");
  EXPECT_EQ(value("Plant.Cpu.Main.count"), "0");
  EXPECT_EQ(value("cpu.main.count"), "0");
  EXPECT_EQ(value("Main.table[2,2]"), "7");
  EXPECT_EQ(value(" Main.table[ 1 , 0 ] "), "0");
  EXPECT_EQ(value("Main.name"), "'a$'b'");
  EXPECT_EQ(value("Main.other.y"), "0");
  EXPECT_EQ(value("Main.valve"), "FALSE");
  EXPECT_EQ(value("%QX0.2"), "FALSE");
}

TEST_F(Paths, DescribesTheProblem) {
  EXPECT_EQ(value("Mian.level"), "unknown variable `Mian.level`; did you mean `Main`?");
  EXPECT_EQ(value("Main.levl"), "`Main` has no variable `levl`; did you mean `Level`?");
  EXPECT_EQ(value("Main.table[3,0]"), "index 3 of `Main.table` is outside 1..2");
  EXPECT_EQ(value("Main.table[1]"), "`Main.table` has 2 dimension(s), not 1");
  EXPECT_EQ(value("Main.table[1"), "expected `]` after `Main.table`[");
  EXPECT_EQ(value("Main.count.40"), "`Main.count` has no bit `40`");
  EXPECT_EQ(value("Main.level.x"), "`Main.Level` has no fields");
  EXPECT_EQ(value("%QW7"), "`%QW7` is outside the image, of which the program uses 1 bytes");
  EXPECT_EQ(value(""), "expected the path of a variable");
  EXPECT_EQ(value("Main."), "`Main` has no variable ``");
}

TEST_F(Paths, SetValues) {
  EXPECT_EQ(set("Main.bits.3", "TRUE"), "");
  EXPECT_EQ(value("Main.bits"), "8");
  EXPECT_EQ(set("Main.bits.%X12", "1"), "");
  EXPECT_EQ(value("Main.bits"), "4104");
  EXPECT_EQ(set("Main.valve", "TRUE"), "");
  EXPECT_EQ(memory.area(1)[0], 4);
  EXPECT_EQ(set("Main.color", "Color#Blue"), "");
  EXPECT_EQ(value("Main.color"), "Blue");
  EXPECT_EQ(set("Main.color", "red"), "");
  EXPECT_EQ(value("Main.color"), "Red");
  EXPECT_EQ(set("Main.other.x", "-3"), "");
  EXPECT_EQ(value("Main.point.x"), "-3");
  EXPECT_EQ(set("speed", "16#1234"), "");
  EXPECT_EQ(memory.area(0)[2], 0x34);
  EXPECT_EQ(set("Main.color", "Gren"), "`Gren` is not an item of Color; did you mean `Green`?");
  EXPECT_EQ(set("Main.count", "x"), "`x` is not a value of type DINT");
  EXPECT_EQ(set("Main.table", "1"), "`Main.table` is an array; set its elements one by one");
}

TEST_F(Paths, ExpandWholePrograms) {
  std::string all;
  std::vector<Variable> variables;
  for (const Variable& root : symbols.programRoots()) symbols.expand(root, variables, Symbols::Detail::Own);
  for (const Variable& variable : variables) all += variable.path + ' ';
  EXPECT_EQ(
      all,
      "Main.run Main.count Main.Level Main.elapsed Main.color Main.table[1,0] Main.table[1,1] Main.table[1,2] "
      "Main.table[2,0] Main.table[2,1] Main.table[2,2] Main.name Main.point.x Main.point.y Main.bits Main.divisor "
      "Main.start_event Main.kept Main.kept_always Main.valve ");
}

TEST(Lists, SplitOutsideBrackets) {
  EXPECT_EQ(splitList("a[1,2], b ,,c"), (std::vector<std::string>{"a[1,2]", "b", "c"}));
}

}  // namespace
