// SPDX-License-Identifier: Apache-2.0
// Characters of string literals: which are written as themselves, with `$`, or as a code.
#include "frontend/source/quoting.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

std::string quoted(char c, char quote, bool escape, bool four_digits = false) {
  std::string out;
  appendInQuotes(out, c, quote, escape, four_digits);
  return out;
}

TEST(Quoting, TheQuoteAndTheDollar) {
  EXPECT_EQ(quoted('\'', '\'', false), "$'");
  EXPECT_EQ(quoted('"', '\'', false), "\"");
  EXPECT_EQ(quoted('$', '"', false), "$$");
  EXPECT_EQ(quoted('$', '"', true), "$$");
}

TEST(Quoting, Codes) {
  EXPECT_EQ(quoted('\n', '\'', true), "$0A");
  EXPECT_EQ(quoted('\xe4', '\'', true), "$E4");
  EXPECT_EQ(quoted('\x7f', '"', true, true), "$007F");
  EXPECT_EQ(quoted('a', '\'', false), "a");
}

TEST(Quoting, ControlCharacters) {
  EXPECT_TRUE(isControl('\0'));
  EXPECT_TRUE(isControl('\x1f'));
  EXPECT_TRUE(isControl('\x7f'));
  EXPECT_FALSE(isControl(' '));
  EXPECT_FALSE(isControl('\xe4'));
}

}  // namespace
}  // namespace rung
