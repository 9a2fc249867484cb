// SPDX-License-Identifier: Apache-2.0
// Mangling and literals.
#include "codegen/names.h"

#include <gtest/gtest.h>

#include <set>

#include "codegen/emit.h"

namespace rung::codegen {
namespace {

TEST(Mangle, KeepsTheSpelling) {
  EXPECT_EQ(mangle("Ramp"), "Ramp_");
  for (const char* name : {"nan", "pid", "class", "INT_MAX", "main", "errno", "this", "delay"}) {
    EXPECT_EQ(mangle(name), std::string(name) + "_");
  }
}

TEST(Mangle, NeverTwoNamesInOne) {
  std::set<std::string> seen;
  const char* names[] = {"a",        "_a",       "__a", "a_",     "ua0u",    "u__a0u", "_u_a",
                         "\xc3\xa4", "_xc3_xa4", "x.y", "x_x2ey", "_x_x2ey", "1a"};
  for (const char* name : names) EXPECT_TRUE(seen.insert(mangle(name)).second) << name;
}

TEST(Mangle, NoReservedNameAtTheFront) {
  EXPECT_EQ(mangle("__LINE_"), "u____LINE__0u");
  EXPECT_EQ(mangle("\xc3\xa4"), "u_xc3_xa40u");
}

TEST(Mangle, LongNamesHaveShortFiles) {
  const std::string a(300, 'a'), b = a + "b";
  EXPECT_LE(fileStem(a).size(), 100u);
  EXPECT_NE(fileStem(a), fileStem(b));
}

TEST(Literals, QuotesAndEscapes) {
  std::string out;
  appendQuoted(out,
               "a\"b\\?\n\xc3\xa4"
               "1");
  EXPECT_EQ(out, R"("a\"b\\\?\012\303\2441")");
  out.clear();
  appendQuotedWide(out, "a\xc3\xa4\xf0\x9f\x98\x80");
  EXPECT_EQ(out, R"(u"a\x00e4" u"\xd83d" u"\xde00" u"")");
  EXPECT_EQ(wideLength("a\xc3\xa4\xf0\x9f\x98\x80"), 4u);
}

}  // namespace
}  // namespace rung::codegen
