// SPDX-License-Identifier: Apache-2.0
// Interning: one id per spelling, one key per identifier, strings that do not move.
#include "frontend/source/names.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

TEST(Names, SpellingsShareAKey) {
  Names names;
  const NameId a = names.intern("MotorSpeed"), b = names.intern("MOTORSPEED"), c = names.intern("MotorSpeed");
  EXPECT_EQ(a, c);
  EXPECT_NE(a, b);
  EXPECT_TRUE(names.same(a, b));
  EXPECT_EQ(names.key(b), a);
  EXPECT_EQ(names.string(b), "MOTORSPEED");
  EXPECT_EQ(names.find("motorspeed"), a);
  EXPECT_FALSE(names.find("motor"));
}

TEST(Names, OnlyLettersFold) {
  Names names;
  EXPECT_FALSE(names.same(names.intern("a_b"), names.intern("a\x7f"
                                                            "b")));
  EXPECT_FALSE(names.same(names.intern("x@1"), names.intern("x`1")));
  EXPECT_FALSE(names.same(names.intern("[]"), names.intern("{}")));
}

TEST(Names, ListIsNamedAfterItsFile) {
  EXPECT_EQ(listNameOf("plant/Limits.st"), "Limits");
  EXPECT_EQ(listNameOf("plant\\Limits (GVL).st"), "Limits");
  EXPECT_EQ(listNameOf("Limits(gvl).st"), "Limits");
  EXPECT_EQ(listNameOf("Limits (2).st"), "Limits__2_");  // a copy
  EXPECT_EQ(listNameOf("(GVL).st"), "_GVL_");
  EXPECT_EQ(listNameOf(" (GVL).st"), "__GVL_");
  EXPECT_EQ(listNameOf("Limits ().st"), "Limits___");
  EXPECT_EQ(listNameOf("Limits).st"), "Limits_");
  EXPECT_EQ(listNameOf("3 (GVL).st"), "globals_3");
}

TEST(Names, EmptyIsNoName) {
  Names names;
  EXPECT_FALSE(names.intern(""));
  EXPECT_FALSE(names.find(""));
  EXPECT_EQ(names.string({}), "");
}

TEST(Names, ManyNamesOfEveryLength) {
  Names names;
  std::vector<NameId> ids;
  std::string text;
  for (int i = 0; i < 50000; ++i) {
    text = std::string(static_cast<size_t>(i % 40), 'x') + std::to_string(i);
    ids.push_back(names.intern(text));
  }
  for (int i = 0; i < 50000; ++i) {
    text = std::string(static_cast<size_t>(i % 40), 'x') + std::to_string(i);
    ASSERT_EQ(names.string(ids[static_cast<size_t>(i)]), text);
    ASSERT_EQ(names.intern(text), ids[static_cast<size_t>(i)]);
    for (char& c : text) c = c == 'x' ? 'X' : c;
    ASSERT_EQ(names.find(text), ids[static_cast<size_t>(i)]);
  }
}

TEST(Names, LongerThanABlock) {
  Names names;
  const std::string text(200000, 'n');
  EXPECT_EQ(names.string(names.intern(text)), text);
  EXPECT_EQ(names.string(names.intern("short")), "short");
}

}  // namespace
}  // namespace rung
